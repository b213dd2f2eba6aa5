// SPDX-License-Identifier: Apache-2.0
// A moving subject: the view follows it, the levels follow the view, and nothing jumps.
#include "controller/design/follow.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace chiaro::design {
namespace {

constexpr double kFrame = 1.0 / 30;

class Following : public testing::Test {
 protected:
  Following() : studio(support::ball_studio(folder.path(), 3)) {
    auto built = twin::build_geometry(studio, {});
    EXPECT_TRUE(built);
    geometry = *built;
    options.size = {64, 64};
    look = studio::placed_rig(studio);
    for (core::FixtureState& state : look.states) state.set(core::Dof::intensity, 0.2);
    // A picture of the ball under its own lamps: every level is known to do.
    const auto view =
        render::see(std::make_shared<render::Tracer>(geometry), studio.main_camera(), options.size);
    studio::Rig lit = look;
    lit.states[0].set(core::Dof::intensity, 0.5);
    example.name = "the ball";
    example.exemplar = render::picture(view, twin::lit_by(studio, geometry, lit));
    example.objective = Objective::wavelet;
  }
  render::Motion swing(double seconds) const {
    const core::Vec3 about = geometry->aim.origin;
    return render::turned_and_moved(about, 0.3 * std::sin(2 * seconds),
                                    {0.15 * std::sin(1.5 * seconds), 0.05 * seconds, 0});
  }

  support::Folder folder;
  studio::Studio studio;
  std::shared_ptr<const twin::Geometry> geometry;
  studio::Rig look;
  ExampleGoal example;
  FollowOptions options;
};

TEST_F(Following, TheViewShowsTheSubjectWhereItHasMoved) {
  const render::Motion moved = swing(0.7);
  const auto seen =
      render::see(render::MovingTracer(geometry).at(moved), studio.main_camera(), options.size);
  twin::Geometry copy = *geometry;
  for (twin::Mesh& mesh : copy.meshes) {
    if (!mesh.subject) continue;
    const auto turn = [](std::vector<float>& list, const auto& by) {
      for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
        const core::Vec3 to = by(core::Vec3{list[i], list[i + 1], list[i + 2]});
        list[i] = static_cast<float>(to.x), list[i + 1] = static_cast<float>(to.y);
        list[i + 2] = static_cast<float>(to.z);
      }
    };
    turn(mesh.positions, [&](core::Vec3 p) { return moved.point(p); });
    turn(mesh.normals, [&](core::Vec3 n) { return moved.direction(n); });
  }
  const auto rebuilt =
      render::see(std::make_shared<render::Tracer>(std::make_shared<twin::Geometry>(copy)),
                  studio.main_camera(), options.size);
  ASSERT_EQ(seen.buffer.samples(), rebuilt.buffer.samples());
  std::size_t subject = 0;
  for (std::size_t i = 0; i < seen.buffer.samples(); ++i) {
    if (seen.buffer.object[i] != rebuilt.buffer.object[i]) continue;  // on the very outline
    subject += seen.buffer.objects[seen.buffer.object[i] - 1u].subject;
    EXPECT_NEAR(seen.buffer.position_x[i], rebuilt.buffer.position_x[i], 1e-3);
    EXPECT_NEAR(seen.buffer.position_z[i], rebuilt.buffer.position_z[i], 1e-3);
    EXPECT_NEAR(seen.buffer.normal_x[i], rebuilt.buffer.normal_x[i], 1e-3);
    EXPECT_NEAR(seen.buffer.normal_y[i], rebuilt.buffer.normal_y[i], 1e-3);
  }
  EXPECT_GT(subject, 200u);
}

TEST_F(Following, LevelsSettleOnTheSolutionOfASubjectThatStandsStill) {
  Follower follower(studio, geometry, example, look, {}, options);
  Follower::Frame frame;
  for (int i = 0; i < 25; ++i) frame = follower.follow({}, 0.2);
  EXPECT_NEAR(frame.rig.states[0].get(core::Dof::intensity), 0.5, 0.03);
  EXPECT_NEAR(frame.rig.states[1].get(core::Dof::intensity), 0.2, 0.05);
  EXPECT_LT(frame.change, 1e-3);
}

TEST_F(Following, NoLevelJumpsHoweverTheSubjectMoves) {
  Follower follower(studio, geometry, example, look, {}, options);
  studio::Rig last = look;
  for (int i = 0; i < 20; ++i) {
    // A tracker that trembles, and once loses its subject for a frame.
    const double shake = i % 2 == 0 ? 0.01 : -0.01;
    const double when = i == 8 ? 5.0 : i * kFrame;
    const auto frame = follower.follow(swing(when + shake), kFrame);
    double change = 0;
    for (std::size_t k = 0; k < studio.fixtures.size(); ++k)
      change = std::max(change, std::abs(frame.rig.states[k].get(core::Dof::intensity) -
                                         last.states[k].get(core::Dof::intensity)));
    EXPECT_LE(change, options.most_per_s * kFrame + 1e-9) << i;
    EXPECT_DOUBLE_EQ(frame.change, change);
    EXPECT_TRUE(std::isfinite(frame.cost));
    last = frame.rig;
  }
}

TEST_F(Following, LockedLampsAndPlacesStayAsTheyAre) {
  Follower follower(studio, geometry, example, look, {studio.fixtures[1].name}, options);
  const auto frame = follower.follow(swing(1), kFrame);
  EXPECT_EQ(frame.rig.states[1], look.states[1]);
  core::FixtureState now = frame.rig.states[0];
  now.set(core::Dof::intensity, look.states[0].get(core::Dof::intensity));
  EXPECT_EQ(now, look.states[0]);
}

TEST_F(Following, ComponentsAreFollowedToo) {
  example.objective = Objective::perceptual;
  Follower follower(studio, geometry, example, look, {}, options);
  const double first = follower.follow({}, kFrame).cost;
  EXPECT_TRUE(std::isfinite(first));
  EXPECT_NEAR(follower.follow({}, kFrame).cost, first, 1e-9);
}

/// The look is kept: no picture is wanted but the light that the subject had.
class Keeping : public Following {
 protected:
  Keeping() { options.settle_s = 0.05; }
  double level(const Follower::Frame& frame, std::size_t lamp = 0) const {
    return frame.rig.states[lamp].get(core::Dof::intensity);
  }
  /// The first lamp becomes a moving head that points at the ball.
  void mount_head() {
    studio::Fixture& fixture = studio.fixtures[0];
    studio::PanTiltMount mount;
    mount.at = {-1, -1.2, 2.2};
    mount.aim_at = geometry->aim.origin;
    fixture.mount = mount;
    fixture.profile.optic.kind = studio::Optic::Kind::spot;
    fixture.profile.optic.beam = core::radians(12);
    fixture.profile.optic.field = core::radians(20);
    fixture.patch = studio::DmxPatch{1, 1};
    studio::Mode mode;
    for (const auto& [dof, reach] : {std::pair(core::Dof::intensity, core::Range{0, 1}),
                                     {core::Dof::pan, core::Range{-4.7, 4.7}},
                                     {core::Dof::tilt, core::Range{-2, 2}}}) {
      studio::Channel channel;
      channel.dof = dof;
      channel.offset = static_cast<int>(mode.channels.size());
      channel.segments = {{0, 1, reach.least, reach.most, studio::Segment::Law::continuous}};
      mode.channels.push_back(channel);
    }
    mode.footprint = 3;
    fixture.profile.modes = {mode};
    look.states[0] = {};
    look.states[0].set(core::Dof::intensity, 0.2);
    look.states[0].set(core::Dof::pan, 0);
    look.states[0].set(core::Dof::tilt, 0);
  }
};

TEST_F(Keeping, ASubjectThatStandsStillKeepsEveryLevel) {
  Follower follower(studio, geometry, look, {}, options);
  for (int i = 0; i < 5; ++i) {
    const auto frame = follower.follow({}, kFrame);
    EXPECT_TRUE(frame.in_view);
    for (std::size_t k = 0; k < studio.fixtures.size(); ++k)
      EXPECT_NEAR(level(frame, k), 0.2, 2e-3) << studio.fixtures[k].name;
  }
}

TEST_F(Keeping, ASubjectThatGoesFromItsLampGetsAsMuchLightAsBefore) {
  for (std::size_t k = 1; k < studio.fixtures.size(); ++k)
    look.states[k].set(core::Dof::intensity, 0);
  Follower follower(studio, geometry, look, {studio.fixtures[1].name, studio.fixtures[2].name},
                    options);
  const core::Vec3 lamp = twin::pose(studio.fixtures[0], look.states[0], geometry->aim).position;
  const core::Vec3 aim = geometry->aim.origin;
  render::Motion moved;
  moved.by = 0.25 * unit(aim - lamp);  // straight away: its light comes from where it came
  Follower::Frame frame;
  for (int i = 0; i < 20; ++i) frame = follower.follow(moved, 0.2);
  const double farther = core::distance(lamp, aim + moved.by) / core::distance(lamp, aim);
  EXPECT_NEAR(level(frame) / 0.2, farther * farther, 0.1);
  EXPECT_LT(frame.change, 1e-3);
}

TEST_F(Keeping, ASubjectOutOfViewLeavesTheLampsAsTheyAre) {
  Follower follower(studio, geometry, look, {}, options);
  render::Motion moved;
  moved.by = {30, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const auto frame = follower.follow(moved, kFrame);
    EXPECT_FALSE(frame.in_view);
    EXPECT_EQ(frame.rig, look);
  }
}

TEST_F(Keeping, ALampThatDoesNotReachTheSubjectStaysAsItIs) {
  studio.fixtures[2].mount = studio::FixedMount{{0, 1, 2.4}, {0, 1.2, 1.4}};  // on the wall
  studio.fixtures[2].profile.optic.kind = studio::Optic::Kind::spot;
  studio.fixtures[2].profile.optic.beam = core::radians(10);
  studio.fixtures[2].profile.optic.field = core::radians(20);
  Follower follower(studio, geometry, look, {}, options);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(follower.follow(swing(0.2 * i), kFrame).rig.states[2], look.states[2]);
}

TEST_F(Keeping, AHeadTurnsAfterTheSubjectAndNeverJumps) {
  mount_head();
  Follower follower(studio, geometry, look, {}, options);
  render::Motion moved;
  moved.by = {0.3, 0.1, 0};
  studio::Rig last = look;
  Follower::Frame frame;
  for (int i = 0; i < 60; ++i) {
    frame = follower.follow(moved, kFrame);
    EXPECT_LE(frame.turn, options.turn_per_s * kFrame + 1e-9);
    for (const core::Dof dof : {core::Dof::pan, core::Dof::tilt})
      EXPECT_LE(std::abs(frame.rig.states[0].get(dof) - last.states[0].get(dof)),
                frame.turn + 1e-12);
    last = frame.rig;
  }
  const twin::Pose pose = twin::pose(studio.fixtures[0], frame.rig.states[0], geometry->aim);
  const core::Vec3 way = geometry->aim.origin + moved.by - pose.position;
  EXPECT_GT(dot(unit(way), pose.direction), std::cos(core::radians(0.5)));
}

TEST_F(Keeping, ALampOnATrackGoesWithTheSubjectAndNeverJumps) {
  studio::TrackMount track;
  track.from = {-1.6, -1.4, 1.9};
  track.to = {1.6, -1.4, 1.9};
  track.axis.slot = 2;
  studio.fixtures[0].mount = track;
  look.states[0] = {};
  look.states[0].set(core::Dof::intensity, 0.3);
  look.states[0].set(core::Dof::track, 0.4);
  for (std::size_t k = 1; k < 3; ++k) look.states[k].set(core::Dof::intensity, 0);
  Follower follower(studio, geometry, look, {studio.fixtures[1].name, studio.fixtures[2].name},
                    options);
  // It turns to its left, and the light that it had is now further to its left.
  const render::Motion moved = render::turned_and_moved(geometry->aim.origin, 0.35, {});
  double at = 0.4, first = 0;
  Follower::Frame frame;
  for (int i = 0; i < 60; ++i) {
    frame = follower.follow(moved, kFrame);
    if (i == 0) first = frame.cost;
    EXPECT_LE(frame.travel, options.travel_per_s * kFrame + 1e-9);
    EXPECT_NEAR(std::abs(frame.rig.states[0].get(core::Dof::track) - at), frame.travel, 1e-9);
    at = frame.rig.states[0].get(core::Dof::track);
  }
  EXPECT_GT(at, 0.45);
  EXPECT_LT(frame.cost, 0.8 * first);
}

}  // namespace
}  // namespace chiaro::design
