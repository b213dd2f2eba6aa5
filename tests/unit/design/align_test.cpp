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

TEST(Align, AWindowLaysFaceOnFace) {
  const FaceBox ours{0.5, 0.43, 0.26}, theirs{0.7, 0.3, 0.13};
  const Window window = window_for(ours, theirs);
  EXPECT_NEAR(window.side, 0.5, 1e-12);
  // Where our face is, the window shows theirs.
  EXPECT_NEAR(window.x + window.side * (ours.x - 0.5), theirs.x, 1e-12);
  EXPECT_NEAR(window.y + window.side * (ours.y - 0.5), theirs.y, 1e-12);
  EXPECT_NEAR(window_for(ours, ours).side, 1, 1e-12);
}

TEST(Align, AMirroredWindowExchangesLeftAndRight) {
  core::Picture two(core::Size{2, 2});
  two.set(0, 0, {1, 1, 1});
  two.set(0, 1, {1, 1, 1});
  const core::Picture seen = seen_through(two, {0.5, 0.5, 1, true}, {2, 2});
  EXPECT_FLOAT_EQ(seen.red.at(0, 0), 0);
  EXPECT_FLOAT_EQ(seen.red.at(1, 0), 1);
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
