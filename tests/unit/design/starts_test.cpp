// SPDX-License-Identifier: Apache-2.0
#include "controller/design/starts.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"

namespace chiaro::design {
namespace {

// [I-10]
TEST(Starts, FacingDirectionsOfABallLookAtTheCameraAndAside) {
  const studio::Studio studio = support::analytic_studio();
  const support::AnalyticLayers layers(studio, {64, 64});
  const auto directions = facing_directions(*layers.geometry(), 3);
  ASSERT_EQ(directions.size(), 3u);
  for (const core::Vec3 d : directions) {
    EXPECT_NEAR(core::length(d), 1, 1e-9);
    EXPECT_LT(d.y, 0.1) << "a visible surface faces the camera, which looks along +y";
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      EXPECT_GT(core::degrees(core::angle_between(directions[i], directions[j])), 30);
}

TEST(Starts, FacingDirectionsOfNothingAreNone) {
  core::GeometryPlanes empty;
  EXPECT_TRUE(facing_directions(empty, 3).empty());
}

TEST(Starts, BendsDrawTheLightToWhereTheSurfaceTurns) {
  // The left half of the picture is flat and faces the camera, the right half rolls away.
  core::GeometryPlanes planes;
  const core::Size size{32, 8};
  planes.subject = core::Grid<std::uint8_t>(size, 1);
  planes.normal_x = planes.normal_y = planes.normal_z = core::Plane(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double turn = x < 16 ? 0 : core::radians(80) * (x - 16) / 15;
      planes.normal_x.at(x, y) = static_cast<float>(std::sin(turn));
      planes.normal_y.at(x, y) = static_cast<float>(-std::cos(turn));
    }
  const auto even = facing_directions(planes, 1), bent = facing_directions(planes, 1, true);
  ASSERT_EQ(even.size(), 1u);
  ASSERT_EQ(bent.size(), 1u);
  EXPECT_LT(core::degrees(std::atan2(even[0].x, -even[0].y)), 25);
  EXPECT_NEAR(core::degrees(std::atan2(bent[0].x, -bent[0].y)), 40, 3);
}

TEST(Starts, EveryGuessHasANameAndStaysWithinTheRegions) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-20), core::radians(10), 2.2}, 3000),
                     support::stand_lamp("fill", studio::Role::fill,
                                         {core::radians(30), core::radians(10), 2.2}, 3000)};
  const support::AnalyticLayers layers(studio, {32, 32});
  const Variables variables = variables_of(studio, {});
  const Target target;
  const measure::PixelMap map = measure::flat_pixel_map({32, 32});
  const Setting setting{studio, layers, variables, target, map, Accuracy::cached};
  const optimise::Point placed = variables.point(variables.base);
  ASSERT_GE(guesses().size(), 3u);
  for (const Guess& guess : guesses()) {
    EXPECT_FALSE(guess.name.empty());
    const optimise::Point point = guess.from(setting, placed);
    ASSERT_EQ(point.size(), placed.size()) << guess.name;
    EXPECT_NE(point, placed) << guess.name;
    for (std::size_t i = 0; i < point.size(); ++i) {
      EXPECT_GE(point[i], variables.moving[i].range.least) << guess.name;
      EXPECT_LE(point[i], variables.moving[i].range.most) << guess.name;
    }
  }
}

// [I-1]
TEST(Variables, AreTheStandsPlacementsInOrderWithTheirRegions) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 800),
                     support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-40), core::radians(30), 2.2}, 3000)};
  studio.fixtures[1].limits.most = 0.8;
  std::get<studio::StandMount>(studio.fixtures[1].mount).region.distance = {2.2, 2.2};
  const Variables variables = variables_of(studio, {});
  ASSERT_EQ(variables.moving.size(), 2u) << "a distance of no width is no variable";
  EXPECT_EQ(variables.moving[0].dof, core::Dof::azimuth);
  EXPECT_EQ(variables.moving[1].dof, core::Dof::elevation);
  EXPECT_EQ(variables.movers(), (std::vector<std::size_t>{1}));
  EXPECT_EQ(variables.limits[1].most, 0.8);
  const auto rig = variables.rig(std::vector<double>{0.25, 0.5});
  EXPECT_EQ(rig.states[1].get(core::Dof::azimuth), 0.25);
  EXPECT_EQ(variables.point(rig), (optimise::Point{0.25, 0.5}));
}

TEST(Variables, LeaveUncontrolledPracticalsAlone) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::fixed_lamp("window", studio::Role::practical, {1, 1, 1}, 800)};
  studio.fixtures[0].controlled = false;
  const Variables variables = variables_of(studio, {});
  EXPECT_TRUE(variables.lit.empty());
  EXPECT_EQ(variables.held, (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace chiaro::design
