// SPDX-License-Identifier: Apache-2.0
#include "controller/design/starts.h"

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
