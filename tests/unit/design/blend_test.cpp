// SPDX-License-Identifier: Apache-2.0
#include "controller/design/blend.h"

#include <gtest/gtest.h>

#include "controller/core/colour.h"

namespace chiaro::design {
namespace {

ExampleGoal flat(const std::string& name, core::Rgb colour, core::Size size = {8, 8}) {
  ExampleGoal goal;
  goal.name = name;
  goal.exemplar = core::Picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) goal.exemplar.set(x, y, colour);
  return goal;
}

TEST(Blended, EndsAreTheExemplarsThemselves) {
  const ExampleGoal dark = flat("dark", {0.1, 0.1, 0.1}), bright = flat("bright", {0.8, 0.8, 0.8});
  EXPECT_NEAR(blended(dark, bright, 0).exemplar.red.at(3, 3), 0.1f, 1e-6f);
  EXPECT_NEAR(blended(dark, bright, 1).exemplar.red.at(3, 3), 0.8f, 1e-5f);
}

TEST(Blended, HalfWayIsHalfWayInLightness) {
  // L* of 0.1 is 37.84, of 0.8 is 91.69: half way is 64.76.
  const core::Picture half =
      blended(flat("a", {0.1, 0.1, 0.1}), flat("b", {0.8, 0.8, 0.8}), 0.5).exemplar;
  const double lightness = core::lightness(core::luminance(half.at(2, 2)));
  EXPECT_NEAR(lightness, (core::lightness(0.1) + core::lightness(0.8)) / 2, 1e-3);
}

TEST(Blended, ColoursMixAndABlackPixelMakesNoTrouble) {
  const core::Rgb warm =
      blended(flat("w", {0.5, 0.4, 0.2}), flat("n", {0.4, 0.4, 0.4}), 0.5).exemplar.at(1, 1);
  EXPECT_GT(warm.r, warm.b);
  EXPECT_LT(warm.r / warm.b, 2.5);
  const core::Rgb grey = blended(flat("k", {0, 0, 0}), flat("k", {0, 0, 0}), 0.3).exemplar.at(0, 0);
  EXPECT_EQ(grey.r, 0);
}

TEST(Blended, PicturesOfOtherShapesMeetInTheFirstOnesSquare) {
  const core::Picture out =
      blended(flat("a", {0.2, 0.2, 0.2}, {16, 8}), flat("b", {0.2, 0.2, 0.2}, {5, 9}), 0.4)
          .exemplar;
  EXPECT_EQ(out.size(), (core::Size{8, 8}));
}

TEST(Blended, TargetsOf3dExemplarsAreInterpolatedWhereBothHaveThem) {
  ExampleGoal a = flat("a", {0.2, 0.2, 0.2}), b = flat("b", {0.4, 0.4, 0.4});
  a.targets3d.emplace();
  a.targets3d->mean = 50;
  a.targets3d->edge = 0.2;
  b.targets3d.emplace();
  b.targets3d->mean = 100;
  const ExampleGoal out = blended(a, b, 0.4);
  ASSERT_TRUE(out.targets3d);
  EXPECT_DOUBLE_EQ(*out.targets3d->mean, 70);
  EXPECT_FALSE(out.targets3d->edge);
  b.targets3d.reset();
  EXPECT_FALSE(blended(a, b, 0.4).targets3d);
}

}  // namespace
}  // namespace chiaro::design
