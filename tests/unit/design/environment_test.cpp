// SPDX-License-Identifier: Apache-2.0
// Light like in a place: an environment's irradiance, and lamps that stand for it.
#include "controller/design/environment.h"

#include <gtest/gtest.h>

#include "controller/design/geometric_layers.h"
#include "tests/support/meshes.h"

namespace chiaro::design {
namespace {

/// Light from one place of the sphere alone; x, y in shares of the probe.
core::Picture sun(double x, double y, core::Rgb colour) {
  core::Picture probe({64, 32});
  probe.set(static_cast<int>(64 * x), static_cast<int>(32 * y), colour);
  return probe;
}

TEST(Environment, AnEvenSkyLightsEverySurfaceByPiTimesItsRadiance) {
  core::Picture probe({32, 16});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) probe.set(x, y, {0.5, 1, 2});
  const Irradiance even(probe);
  for (const core::Vec3 n : {core::Vec3{0, 0, 1}, core::Vec3{0, -1, 0}, core::Vec3{1, 0, 0}}) {
    EXPECT_NEAR(even.at(n).r, core::kPi / 2, 0.02);
    EXPECT_NEAR(even.at(n).g, core::kPi, 0.04);
    EXPECT_NEAR(even.at(n).b, core::kPi * 2, 0.08);
  }
}

TEST(Environment, ItsMiddleIsTowardsTheCameraAndItsRightAtTheCamerasLeft) {
  const Irradiance front(sun(0.5, 0.5, {1, 1, 1})), right(sun(0.75, 0.5, {1, 1, 1})),
      above(sun(0.5, 0.02, {1, 1, 1}));
  EXPECT_GT(front.at({0, -1, 0}).g, 5 * front.at({1, 0, 0}).g);
  EXPECT_GT(right.at({-1, 0, 0}).g, 5 * right.at({0, -1, 0}).g);
  EXPECT_GT(above.at({0, 0, 1}).g, 5 * above.at({0, -1, 0}).g);
}

TEST(Environment, TheKeyTakesTheSunsSide) {
  const support::Folder folder;
  const studio::Studio studio = support::ball_studio(folder.path(), 3);
  const auto twin = geometric_layers(studio, {});
  ASSERT_TRUE(twin);
  // High on the camera's right: the probe's left half.
  const auto goal =
      environment_goal(studio, **twin, sun(0.38, 0.3, {1, 1, 1}), "sun", 55, {64, 64});
  ASSERT_TRUE(goal) << core::to_string(goal.problems());
  double left = 0, right = 0;
  const core::Plane light = core::luminance(goal->exemplar);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) (x < 32 ? left : right) += double{light.at(x, y)};
  EXPECT_GT(right, 1.5 * left);
  Options options;
  options.search_size = options.polish_size = options.full_size = {64, 64};
  options.trials = 150;
  options.threads = 1;
  const auto look = design(studio, **twin, Goal(*goal), options);
  ASSERT_TRUE(look) << core::to_string(look.problems());
  double weighted = 0, all = 0;
  for (const auto& state : look->wanted.states) {
    const double level = state.get(core::Dof::intensity);
    weighted += level * std::sin(state.get(core::Dof::azimuth));
    all += level;
  }
  EXPECT_GT(all, 0);
  EXPECT_GT(weighted / all, 0.2) << "light comes from the camera's right";
}

TEST(Environment, DarknessIsNoEnvironment) {
  const support::Folder folder;
  const studio::Studio studio = support::ball_studio(folder.path(), 2);
  const auto twin = geometric_layers(studio, {});
  ASSERT_TRUE(twin);
  EXPECT_FALSE(environment_goal(studio, **twin, core::Picture({8, 4}), "night", 50, {32, 32}));
}

}  // namespace
}  // namespace chiaro::design
