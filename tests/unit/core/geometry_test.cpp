// SPDX-License-Identifier: Apache-2.0
#include "controller/core/geometry.h"

#include <gtest/gtest.h>
#include <limits>

#include "controller/core/random.h"
#include "controller/core/units.h"

namespace chiaro::core {
namespace {

void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// The usual studio: aim at head height, camera in front, along +Y.
const AimFrame kFrame = aim_frame({0, 0, 1.4}, {0, -2.6, 1.45});

TEST(AimFrame, AzimuthIsPositiveToTheCamerasRight) {
  expect_near(kFrame.towards_camera, {0, -1, 0});
  expect_near(kFrame.camera_right, {1, 0, 0});
  expect_near(position(kFrame, {0, 0, 2}), {0, -2, 1.4});
  expect_near(position(kFrame, {radians(90), 0, 2}), {2, 0, 1.4});
  expect_near(position(kFrame, {radians(-90), 0, 2}), {-2, 0, 1.4});
  expect_near(position(kFrame, {radians(180), 0, 2}), {0, 2, 1.4});
}

TEST(AimFrame, ElevationIsPositiveUpwards) {
  expect_near(position(kFrame, {0, radians(90), 1}), {0, 0, 2.4});
  expect_near(position(kFrame, {0, radians(30), 2}), {0, -std::sqrt(3.0), 2.4});
  expect_near(position(kFrame, {0, radians(-30), 2}), {0, -std::sqrt(3.0), 0.4});
}

TEST(AimFrame, TurnsWithTheCamera) {
  const AimFrame frame = aim_frame({0, 0, 1}, {3, 0, 2});  // the camera looks along -X
  expect_near(frame.towards_camera, {1, 0, 0});
  expect_near(frame.camera_right, {0, 1, 0});
}

TEST(AimFrame, ACameraStraightAboveLooksFromTheFront) {
  expect_near(aim_frame({1, 2, 1}, {1, 2, 5}).towards_camera, {0, -1, 0});
}

TEST(Spherical, AndPositionAreInverse) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const AimFrame frame = aim_frame({random.normal(), random.normal(), random.normal()},
                                     {random.normal(), random.normal(), random.normal()});
    const Spherical place{random.uniform(-kPi, kPi), random.uniform(-1.5, 1.5),
                          random.uniform(0.1, 10)};
    const Spherical back = spherical(frame, position(frame, place));
    EXPECT_NEAR(back.azimuth, place.azimuth, 1e-9);
    EXPECT_NEAR(back.elevation, place.elevation, 1e-9);
    EXPECT_NEAR(back.distance, place.distance, 1e-9);
  }
}

TEST(Angle, KeepsItsPrecisionNearZeroAndHalfATurn) {
  EXPECT_NEAR(angle_between({1, 0, 0}, {1, 1e-9, 0}), 1e-9, 1e-18);
  EXPECT_NEAR(angle_between({1, 0, 0}, {-1, 1e-9, 0}), kPi - 1e-9, 1e-15);
  EXPECT_NEAR(angle_between({2, 0, 0}, {0, 0, 5}), kPi / 2, 1e-15);
}

TEST(Vectors, ByHand) {
  expect_near(cross({1, 0, 0}, {0, 1, 0}), {0, 0, 1});
  EXPECT_DOUBLE_EQ(dot({1, 2, 3}, {4, -5, 6}), 12);
  EXPECT_DOUBLE_EQ(length({2, 3, 6}), 7);
  expect_near(unit({0, 0, -4}), {0, 0, -1});
  expect_near(unit({0, 0, 0}), {0, 0, 0});
  EXPECT_FALSE(finite({0, std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(finite({std::numeric_limits<double>::infinity(), 0, 0}));
  EXPECT_TRUE(finite({1, 2, 3}));
}

TEST(Box, GrowsWithItsPoints) {
  Box3 box;
  EXPECT_TRUE(box.empty());
  box.include({1, 2, 3});
  EXPECT_FALSE(box.empty());
  box.include({-1, 4, 3});
  expect_near(box.centre(), {0, 3, 3});
  expect_near(box.extent(), {2, 2, 0});
}

}  // namespace
}  // namespace chiaro::core
