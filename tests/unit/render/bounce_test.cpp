// SPDX-License-Identifier: Apache-2.0
// Light between surfaces against what can be worked out by hand, and its cache against itself.
#include "controller/render/bounce.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "tests/support/meshes.h"

namespace chiaro::render {
namespace {

using core::Vec3;

studio::Camera camera_at(Vec3 at, Vec3 look_at) {
  studio::Camera camera;
  camera.at = at;
  camera.look_at = look_at;
  camera.vertical_fov = core::radians(40);
  return camera;
}

twin::Light point_light(Vec3 at, double candela) {
  twin::Light light;
  light.position = at;
  light.direction = {0, 0, -1};
  light.candela = candela;
  return light;
}

twin::SurfaceMaterial white_half() {
  twin::SurfaceMaterial material;
  material.diffuse = {0.5, 0.5, 0.5};
  return material;
}

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A small upright card, seen from the front, above a wide floor that a high lamp lights.
std::shared_ptr<const Tracer> card_over_floor(double floor_half) {
  return std::make_shared<const Tracer>(
      support::geometry_of({support::card({0, 0, 1}, {0.05, 0, 0}, {0, 0, 0.05}),
                            support::card({0, -1, 0}, {floor_half, 0, 0}, {0, floor_half, 0})},
                           white_half()));
}

TEST(BounceField, AFloorSendsAnUprightCardHalfOfWhatItsOwnFormFactorSays) {
  // A parallel light straight down: the card gets none, the floor E everywhere. An endless floor
  // fills half the card's sky: E_card = albedo * E / 2 = 0.25 E. The floor's 6 m reach gives less
  // by the sine of the angle it misses: within 10 %.
  const BounceField field(card_over_floor(6), camera_at({0, -1, 1}, {0, 0, 1}));
  twin::Light sun = point_light({0, 0, 0}, 100);
  sun.kind = studio::Optic::Kind::directional;
  sun.direction = {0, 0, -1};
  const Bounced bounced = field.from(sun);
  for (const auto& lux : bounced.lux) {
    ASSERT_FALSE(lux.empty());
    // The card's points lie in the picture's middle; the floor's own get next to nothing back.
    EXPECT_NEAR(*std::max_element(lux.begin(), lux.end()), 25, 3.5);
  }
}

TEST(BounceField, NothingComesFromNothing) {
  const auto alone = std::make_shared<const Tracer>(
      support::geometry_of({support::card({0, 0, 1}, {0.2, 0, 0}, {0, 0, 0.2})}, white_half()));
  const BounceField field(alone, camera_at({0, -1, 1}, {0, 0, 1}));
  const Bounced bounced = field.from(point_light({0, -1, 2}, 1000));
  for (const auto& lux : bounced.lux)
    for (const float v : lux) EXPECT_EQ(v, 0);
}

TEST(BounceField, IsLinearInTheLamp) {
  const BounceField field(card_over_floor(3), camera_at({0, -1, 1}, {0, 0, 1}));
  const double once = mean(field.from(point_light({0.5, -1, 2}, 100)).lux[0]);
  EXPECT_GT(once, 0);
  EXPECT_NEAR(mean(field.from(point_light({0.5, -1, 2}, 300)).lux[0]), 3 * once, 1e-4 * once);
}

TEST(BounceMap, LuminanceIsThatOfTheColours) {
  const auto tracer = card_over_floor(3);
  const auto camera = camera_at({0, -1, 1.2}, {0, 0, 0.9});
  const BounceField field(tracer, camera);
  const View view = see(tracer, camera, {64, 64});
  const BounceMap map(field, view);
  const Bounced bounced = field.from(point_light({0.5, -1, 2}, 100));
  const core::Rgb warm{1.2, 0.95, 0.7};
  core::Plane luminance({64, 64});
  core::Picture colour({64, 64});
  map.add_luminance(bounced, warm, 0.01, luminance);
  map.add_colour(bounced, warm, 0.01, colour);
  const core::Plane wanted = core::luminance(colour);
  double sum = 0;
  for (std::size_t i = 0; i < wanted.values.size(); ++i) {
    EXPECT_NEAR(luminance.values[i], wanted.values[i], 1e-5);
    sum += luminance.values[i];
  }
  EXPECT_GT(sum, 0);
}

TEST(BounceMap, ASubjectTooSmallForTheFieldGetsNothing) {
  const auto tracer = std::make_shared<const Tracer>(
      support::geometry_of({support::card({0, 0, 1}, {0.05, 0, 0}, {0, 0, 0.05})}, white_half()));
  const auto camera = camera_at({0, -40, 1}, {0, 0, 1});
  const BounceField field(tracer, camera);
  const Bounced bounced = field.from(point_light({0, -1, 2}, 1000));
  ASSERT_TRUE(bounced.lux[0].empty());  // an even number of pixels: none looks at the very middle
  const View view = see(tracer, camera, {63, 63});
  ASSERT_EQ(view.buffer.samples(), 1u);
  core::Plane luminance({63, 63});
  core::Picture colour({63, 63});
  const BounceMap map(field, view);
  map.add_luminance(bounced, {1, 1, 1}, 1, luminance);
  map.add_colour(bounced, {1, 1, 1}, 1, colour);
  EXPECT_EQ(mean(luminance.values), 0);
  EXPECT_EQ(mean(colour.red.values), 0);
}

TEST(BounceCache, BlendsToWithinAFewPerCentOfTheTracedField) {
  support::Folder folder;
  const studio::Studio studio = support::ball_studio(folder.path(), 3);
  const auto geometry = twin::build_geometry(studio, {}).value();
  const auto tracer = std::make_shared<const Tracer>(geometry);
  const BounceField field(tracer, studio.main_camera());
  EXPECT_GT(field.patches(), 10u);
  const BounceCache cache(field, studio, geometry->aim);
  for (const double azimuth : {-50.0, -7.0, 33.0}) {
    core::FixtureState state;
    state.set(core::Dof::azimuth, core::radians(azimuth));
    state.set(core::Dof::elevation, core::radians(22));
    state.set(core::Dof::distance, 1.7);
    const Bounced traced = field.from(
        twin::light(studio.fixtures[0], state, geometry->aim, studio.exposure.white_balance));
    const Bounced blended = cache.at(0, state);
    EXPECT_NEAR(mean(blended.lux[1]), mean(traced.lux[1]), 0.08 * mean(traced.lux[1])) << azimuth;
    EXPECT_EQ(cache.at(0, state).lux, blended.lux);
  }
}

}  // namespace
}  // namespace chiaro::render
