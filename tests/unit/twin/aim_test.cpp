// SPDX-License-Identifier: Apache-2.0
// Aiming a head: the inverse of its pose, within what it can turn, by the shorter way.
#include "controller/twin/aim.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/twin/scene.h"

namespace chiaro::twin {
namespace {

using core::Dof;
using core::Range;
using core::Vec3;

studio::PanTiltMount hung() {
  studio::PanTiltMount mount;
  mount.at = {1, -1, 3};
  mount.aim_at = {0, 0, 1.4};
  return mount;
}

Pose posed(const studio::PanTiltMount& mount, PanTilt angles) {
  studio::Fixture fixture;
  fixture.mount = mount;
  core::FixtureState state;
  state.set(Dof::pan, angles.pan);
  state.set(Dof::tilt, angles.tilt);
  return pose(fixture, state, core::aim_frame({0, 0, 1.4}, {0, -2.6, 1.4}));
}

const Range kPan{core::radians(-270), core::radians(270)};
const Range kTilt{core::radians(-200), core::radians(200)};

TEST(AimedAt, PointsTheHeadAtAnyPointThatItCanReach) {
  core::Random random(11);
  const studio::PanTiltMount mount = hung();
  for (int i = 0; i < 2000; ++i) {
    const Vec3 target{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 5)};
    const PanTilt from{random.uniform(kPan.least, kPan.most), random.uniform(-1, 1)};
    const auto aimed = aimed_at(mount, kPan, kTilt, target, from);
    ASSERT_TRUE(aimed);
    EXPECT_TRUE(kPan.contains(aimed->pan) && kTilt.contains(aimed->tilt));
    EXPECT_NEAR(core::distance(posed(mount, *aimed).direction, core::unit(target - mount.at)), 0,
                1e-9);
  }
}

TEST(AimedAt, TurnsTheShorterWayAndNotRightRound) {
  // A target a little beyond half a turn: from +170 degrees the head goes on to +190.
  const studio::PanTiltMount mount = hung();
  const Vec3 target = mount.at + posed(mount, {core::radians(190), 0}).direction;
  const auto on = aimed_at(mount, kPan, {-1, 1}, target, {core::radians(170), 0});
  ASSERT_TRUE(on);
  EXPECT_NEAR(core::degrees(on->pan), 190, 1e-6);
  const auto back = aimed_at(mount, kPan, {-1, 1}, target, {core::radians(-160), 0});
  ASSERT_TRUE(back);
  EXPECT_NEAR(core::degrees(back->pan), -170, 1e-6);
}

TEST(AimedAt, TiltsOverTheTopWhereThatIsNearer) {
  const studio::PanTiltMount mount = hung();
  const double neutral = std::atan2(-1.6, std::sqrt(2.0));
  // Straight behind and level: half a turn of pan, or tilted through straight down.
  const Vec3 target = mount.at + Vec3{1, -1, 0};
  const auto aimed =
      aimed_at(mount, {core::radians(-10), core::radians(10)}, kTilt, target, {0, 0});
  ASSERT_TRUE(aimed);
  EXPECT_NEAR(aimed->pan, 0, 1e-9);
  EXPECT_NEAR(aimed->tilt, -core::kPi - neutral, 1e-9);
}

TEST(AimedAt, KeepsItsPanForAPointOnItsAxisAndHasNoAnswerBeyondItsStops) {
  const studio::PanTiltMount mount = hung();
  const auto below = aimed_at(mount, kPan, kTilt, mount.at - Vec3{0, 0, 2}, {0.7, 0});
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->pan, 0.7, 1e-9);
  EXPECT_FALSE(aimed_at(mount, {-0.1, 0.1}, {-0.1, 0.1}, mount.at + Vec3{1, 1, 0}, {}));
  EXPECT_FALSE(aimed_at(mount, kPan, kTilt, mount.at, {}));
}

TEST(MotorPose, FollowsTheArcsAngleAndTheTracksPlace) {
  const core::AimFrame aim = core::aim_frame({0, 0, 1.4}, {0, -2.6, 1.4});
  studio::Fixture fixture;
  studio::ArcMount arc;
  arc.centre = {0, 0, 1.4};
  arc.radius = 2;
  arc.angle = {-1, 1};
  fixture.mount = arc;
  core::FixtureState state;
  state.set(Dof::arc, core::radians(90));
  EXPECT_NEAR(core::distance(pose(fixture, state, aim).position, {2, 0, 1.4}), 0, 1e-9);
  studio::TrackMount track;
  track.from = {-2, 1, 2.5};
  track.to = {2, 1, 2.5};
  fixture.mount = track;
  state.set(Dof::track, 0.75);
  EXPECT_NEAR(core::distance(pose(fixture, state, aim).position, {1, 1, 2.5}), 0, 1e-9);
}

}  // namespace
}  // namespace chiaro::twin
