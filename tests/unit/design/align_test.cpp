// SPDX-License-Identifier: Apache-2.0
#include "controller/design/align.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

core::Picture lit_ball(core::Size size) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::fixed_lamp("key", studio::Role::key, {-1.2, -1.2, 2.2}, 6000)};
  studio::Rig rig = studio::placed_rig(studio);
  rig.states[0].set(core::Dof::intensity, 0.5);
  return support::photographed(studio, support::AnalyticSource(studio), rig, size);
}

TEST(Align, FindsAShiftAndAScale) {
  const core::Picture ball = lit_ball({128, 128});
  const Window hidden{0.58, 0.45, 1.2};
  const core::Picture moved = seen_through(ball, hidden, {128, 128});
  const Window found = best_window(ball, core::luminance(core::resized(moved, {64, 64})), 1);
  EXPECT_NEAR(found.x, hidden.x, 0.02);
  EXPECT_NEAR(found.y, hidden.y, 0.02);
  EXPECT_NEAR(found.side, hidden.side, 0.04);
}

TEST(Align, LeavesAPictureThatLiesRightAlone) {
  const core::Picture ball = lit_ball({128, 128});
  const Window found = best_window(ball, core::luminance(core::resized(ball, {64, 64})), 1);
  EXPECT_EQ(found.x, 0.5);
  EXPECT_EQ(found.y, 0.5);
  EXPECT_EQ(found.side, 1);
}

TEST(Align, TheWholeSquareIsThePictureItself) {
  const core::Picture ball = lit_ball({64, 64});
  const core::Picture same = seen_through(ball, {}, {64, 64});
  for (std::size_t i = 0; i < ball.red.values.size(); ++i)
    ASSERT_NEAR(same.red.values[i], ball.red.values[i], 1e-6);
}

TEST(Align, BeyondThePictureItsBorderRepeats) {
  core::Picture two(core::Size{2, 1});
  two.set(0, 0, {1, 1, 1});
  const core::Picture wide = seen_through(two, {0.5, 0.5, 4}, {8, 8});
  EXPECT_FLOAT_EQ(wide.red.at(0, 0), 1);
  EXPECT_FLOAT_EQ(wide.red.at(7, 7), 0);
}

}  // namespace
}  // namespace chiaro::design
