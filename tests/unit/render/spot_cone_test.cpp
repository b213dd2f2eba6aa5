// SPDX-License-Identifier: Apache-2.0
#include "controller/render/spot_cone.h"

#include <cmath>
#include <gtest/gtest.h>

namespace chiaro::render {
namespace {

/// A row of samples at y = 0, z = 0: object ids by x.
core::GBuffer row(const std::vector<std::pair<double, std::uint16_t>>& samples) {
  core::GBuffer b;
  b.objects = {{"left", true}, {"right", true}, {"wall", false}};
  for (const auto& [x, id] : samples) {
    b.pixel.push_back(static_cast<std::uint32_t>(b.pixel.size()));
    b.position_x.push_back(static_cast<float>(x));
    b.position_y.push_back(0);
    b.position_z.push_back(0);
    b.object.push_back(id);
  }
  return b;
}

// [I-36]
TEST(SpotCone, HoldsItsObjectNarrowlyAndSparesTheNeighbour) {
  // From (0, -1, 0) the left object spans x = -0.2 .. 0.2: half angle atan 0.2, towards +Y.
  const auto view = row({{-0.2, 1}, {0, 1}, {0.2, 1}, {0.8, 2}, {1, 2}, {0.1, 3}});
  const auto cone = cone_over(view, 1, {0, -1, 0});
  ASSERT_TRUE(cone);
  EXPECT_NEAR(cone->angle, 2 * std::atan(0.2), 0.03 * 2 * std::atan(0.2));
  EXPECT_GE(cone->angle, 2 * std::atan(0.2) - 1e-6);
  EXPECT_NEAR(cone->direction.y, 1, 0.001);
  EXPECT_EQ(cone->spilled, 0);
}

TEST(SpotCone, SaysHowMuchOfTheOthersItCannotSpare) {
  // The neighbour's near half lies between the object's ends; the wall does not count.
  const auto view = row({{-0.5, 1}, {0.5, 1}, {0.1, 2}, {3, 2}, {0, 3}});
  EXPECT_NEAR(cone_over(view, 1, {0, -1, 0})->spilled, 0.5, 1e-9);
}

TEST(SpotCone, AnObjectThatIsNotSeenHasNone) {
  EXPECT_FALSE(cone_over(row({{0, 1}}), 2, {0, -1, 0}));
  EXPECT_FALSE(cone_over(row({{-1, 1}, {1, 1}}), 1, {0, 0, 0}));
}

}  // namespace
}  // namespace chiaro::render
