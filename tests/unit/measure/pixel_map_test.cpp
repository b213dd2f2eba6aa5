// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

/// A wall (object 1) far away and a subject (object 2) square in the middle, facing the camera.
core::GeometryPlanes square_before_wall(int side, int begin, int end) {
  const core::Size size{side, side};
  core::GeometryPlanes p{core::Plane(size, 4.0f),
                         core::Plane(size),
                         core::Plane(size, -1.0f),
                         core::Plane(size),
                         core::Grid<std::uint16_t>(size, 1),
                         core::Grid<std::uint8_t>(size, 0)};
  for (int y = begin; y < end; ++y)
    for (int x = begin; x < end; ++x) {
      p.depth.at(x, y) = 2;
      p.object.at(x, y) = 2;
      p.subject.at(x, y) = 1;
    }
  return p;
}

TEST(PixelMap, MarksTheSubjectsOutlineAsExternalEdge) {
  const PixelMap map = pixel_map(square_before_wall(12, 3, 9));
  EXPECT_EQ(map.edges, 20u);  // the rim of a 6 x 6 square
  EXPECT_EQ(map.externals, 20u);
  EXPECT_EQ(map.surfaces, 16u);
  EXPECT_EQ(map.type.at(3, 3), PixelType::edge);
  EXPECT_EQ(map.type.at(5, 5), PixelType::surface);
  EXPECT_EQ(map.type.at(0, 0), PixelType::background);
}

TEST(PixelMap, InnerStepsAreEdgesButNotExternal) {
  auto p = square_before_wall(16, 2, 14);
  for (int y = 2; y < 14; ++y)
    for (int x = 8; x < 14; ++x) p.depth.at(x, y) = 2.2f;
  const PixelMap map = pixel_map(p);
  EXPECT_EQ(map.type.at(7, 7), PixelType::edge);
  EXPECT_EQ(map.type.at(8, 7), PixelType::edge);
  EXPECT_EQ(map.external.at(7, 7), 0);
  EXPECT_EQ(map.type.at(5, 7), PixelType::surface);
}

TEST(PixelMap, AStepBelowTheThresholdIsNoEdge) {
  auto p = square_before_wall(16, 2, 14);
  for (int y = 2; y < 14; ++y)
    for (int x = 8; x < 14; ++x) p.depth.at(x, y) = 2.02f;  // 1 %
  EXPECT_EQ(pixel_map(p).type.at(7, 7), PixelType::surface);
  EXPECT_EQ(pixel_map(p, {.depth_step = 0.005}).type.at(7, 7), PixelType::edge);
}

TEST(PixelMap, APlaneSeenAtAGrazingAngleHasNoEdges) {
  // Inverse depth of a plane is linear in the picture: here depth falls from 3 m to 1.2 m.
  auto p = square_before_wall(64, 2, 62);
  for (int y = 2; y < 62; ++y)
    for (int x = 2; x < 62; ++x)
      p.depth.at(x, y) = 1 / (1 / 3.0f + 0.5f * static_cast<float>(y) / 61);
  const PixelMap map = pixel_map(p);
  EXPECT_EQ(map.edges, map.externals);
}

// [I-8, I-6]
TEST(PixelMap, NormalsAndObjectIdsMakeEdgesWhereDepthDoesNot) {
  auto p = square_before_wall(16, 2, 14);
  for (int y = 2; y < 14; ++y)
    for (int x = 8; x < 14; ++x) {
      p.normal_x.at(x, y) = static_cast<float>(std::sin(0.8));
      p.normal_y.at(x, y) = static_cast<float>(-std::cos(0.8));
    }
  EXPECT_EQ(pixel_map(p).type.at(7, 7), PixelType::edge);
  EXPECT_EQ(pixel_map(p, {.normal_angle = 1}).type.at(7, 7), PixelType::surface);
  auto q = square_before_wall(16, 2, 14);
  for (int y = 2; y < 14; ++y)
    for (int x = 8; x < 14; ++x) q.object.at(x, y) = 3;
  EXPECT_EQ(pixel_map(q).type.at(8, 7), PixelType::edge);
}

TEST(PixelMap, WithoutASubjectEveryObjectCounts) {
  auto p = square_before_wall(12, 3, 9);
  for (auto& s : p.subject.values) s = 0;
  const PixelMap map = pixel_map(p);
  EXPECT_EQ(map.surfaces + map.edges, 144u);
  EXPECT_EQ(map.externals, 0u);
}

TEST(PixelMap, ASubjectBeforeNothingHasAnOutlineToo) {
  auto p = square_before_wall(12, 3, 9);
  for (std::size_t i = 0; i < p.object.values.size(); ++i)
    if (!p.subject.values[i]) {
      p.object.values[i] = core::kNothing;
      p.depth.values[i] = std::numeric_limits<float>::infinity();
      p.normal_y.values[i] = 0;
    }
  const PixelMap map = pixel_map(p);
  EXPECT_EQ(map.externals, 20u);
  EXPECT_TRUE(map.index.crossings.empty());
}

TEST(PixelMap, ContrastMeetsTheWallOnBothSidesOfEveryRowAndColumn) {
  // 4 rows and 4 columns cross wall | part | wall; along the rim wall meets only wall.
  EXPECT_EQ(pixel_map(square_before_wall(12, 3, 9)).index.crossings.size(), 4u * 2 + 4u * 2);
}

// [I-9]
TEST(LitMask, FollowsTheRule) {
  core::Plane key({2, 1}), fill({2, 1});
  key.values = {1, 0.2f};
  fill.values = {0.5f, 0.9f};
  const core::Plane* both[] = {&key, &fill};
  EXPECT_EQ(lit_mask(both).values, (std::vector<float>{1, 0.2f}));
  EXPECT_EQ(lit_mask(both, ShadowRule::any).values, (std::vector<float>{0.5f, 0.2f}));
  EXPECT_EQ(lit_mask(both, ShadowRule::all).values, (std::vector<float>{1, 0.9f}));
}

}  // namespace
}  // namespace chiaro::measure
