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

}  // namespace
}  // namespace chiaro::design
