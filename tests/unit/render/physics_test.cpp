// SPDX-License-Identifier: Apache-2.0
// Light behaves as light does: laws that hold whatever the code.
#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/render/view.h"
#include "controller/twin/lights/light_model.h"
#include "tests/support/meshes.h"

namespace chiaro::render {
namespace {

using core::Vec3;

/// A grey card at the origin facing the camera at (0, -2, 0), and what else is given.
View card_view(std::vector<twin::Mesh> others = {}, core::Size size = {65, 65}) {
  std::vector<twin::Mesh> meshes{support::card({}, {1, 0, 0}, {0, 0, 1})};
  for (auto& mesh : others) meshes.push_back(std::move(mesh));
  twin::SurfaceMaterial grey;
  grey.diffuse = {0.18, 0.18, 0.18};
  const auto geometry = support::geometry_of(std::move(meshes), grey);
  studio::Camera camera;
  camera.at = {0, -2, 0};
  camera.look_at = {0, 0, 0};
  camera.vertical_fov = core::radians(40);
  return see(std::make_shared<const Tracer>(geometry), camera, size);
}

twin::Light point(Vec3 at, double candela) {
  twin::Light light;
  light.position = at;
  light.direction = unit(-at);
  light.right = unit(cross(light.direction, Vec3{0, 0, 1}));
  light.up = cross(light.right, light.direction);
  light.candela = candela;
  return light;
}
twin::Light rectangle(Vec3 at, double candela, double width, double height) {
  twin::Light light = point(at, candela);
  light.kind = studio::Optic::Kind::rectangle;
  light.width = width;
  light.height = height;
  return light;
}

double centre(const core::Layer& layer) {
  const core::Size size = layer.diffuse.size();
  return layer.diffuse.green.at(size.width / 2, size.height / 2);
}

TEST(Physics, PointLightFallsWithTheSquareOfItsDistance) {
  const View view = card_view();
  const double near = centre(layer(view, point({0, -1, 0}, 100), 1));
  const double far = centre(layer(view, point({0, -3, 0}, 100), 1));
  EXPECT_NEAR(near, 0.18 * 100, 0.01);
  EXPECT_NEAR(near / far, 9, 1e-3);
}

TEST(Physics, GreyCardAtItsIlluminanceIsMidGrey) {
  const View view = card_view();
  studio::Exposure exposure;
  const double gain = studio::exposure_gain(exposure, studio::Camera{});
  // 800 lx head-on: L* 50.
  const double y = centre(layer(view, point({0, -2, 0}, 4 * exposure.grey_card.value), gain));
  EXPECT_NEAR(core::lightness(y), 50, 0.2);
}

TEST(Physics, SoftLightTendsToItsPointLimitFarAway) {
  const View view = card_view();
  const Vec3 towards = unit(Vec3{0.4, -1, 0.5});
  for (const double d : {4.0, 8.0, 16.0}) {
    const double soft = centre(layer(view, rectangle(d * towards, 1000, 0.6, 0.9), 1));
    const double small = centre(layer(view, point(d * towards, 1000), 1));
    EXPECT_NEAR(soft / small, 1, 0.6 / (d * d)) << d;
  }
}

TEST(Physics, RectangleMatchesTheSumOfManySmallSources) {
  const twin::Light light = rectangle({0.5, -0.7, 0.6}, 1000, 0.8, 1.1);
  const auto& model = twin::light_model(studio::Optic::Kind::rectangle);
  core::Random random(7);
  for (const Vec3 normal :
       {Vec3{0, -1, 0}, unit(Vec3{0.9, 0.3, 0.1}), unit(Vec3{-0.6, 0.2, 0.7})}) {
    double sum = 0;
    constexpr int kStrata = 200;
    for (int i = 0; i < kStrata * kStrata; ++i) {
      const Vec3 target = model.target(light, {}, (i % kStrata + random.uniform()) / kStrata,
                                       (i / kStrata + random.uniform()) / kStrata);
      const double d = length(target);
      sum += std::max(0.0, dot(normal, target) / d) *
             std::max(0.0, -dot(light.direction, target) / d) / (d * d);
    }
    const double sampled = light.candela * sum / (kStrata * kStrata);
    EXPECT_NEAR(model.irradiance(light, {}, normal), sampled, 2e-3 * light.candela);
  }
}

TEST(Physics, ShadowEdgeIsWhereGeometrySaysItIs) {
  // A blocker's edge at x = 0.1, half way to the lamp, throws its edge at x = 0.2 on the card.
  const View view =
      card_view({support::card({0.6, -0.5, 0}, {0.5, 0, 0}, {0, 0, 0.02})}, {201, 201});
  const core::Plane seen = visibility(view, point({0, -1, 0}, 100));
  const core::GBuffer& b = view.buffer;
  int lit = 0, dark = 0;
  for (std::size_t i = 0; i < b.samples(); ++i) {
    if (b.object[i] != 1 || std::abs(b.position_z[i]) > 0.03f) continue;
    const double x = b.position_x[i];
    if (x > 0 && x < 0.195) {
      ++lit;
      EXPECT_EQ(seen.values[b.pixel[i]], 1) << x;
    }
    if (x > 0.205 && x < 0.6) {
      ++dark;
      EXPECT_EQ(seen.values[b.pixel[i]], 0) << x;
    }
  }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 50);
}

TEST(Physics, SoftShadowIsHalfWhereHalfTheLampIsHidden) {
  const View view =
      card_view({support::card({0.6, -0.5, 0}, {0.5, 0, 0}, {0, 0, 0.5})}, {201, 201});
  // The lamp's middle disappears at x = 0.2; its ends at 0.1 and 0.3.
  const core::Plane seen = visibility(view, rectangle({0, -1, 0}, 100, 0.2, 0.2));
  const core::GBuffer& b = view.buffer;
  for (std::size_t i = 0; i < b.samples(); ++i) {
    if (b.object[i] != 1 || std::abs(b.position_z[i]) > 0.03f) continue;
    const double x = b.position_x[i], v = seen.values[b.pixel[i]];
    if (x > 0 && x < 0.09) {
      EXPECT_EQ(v, 1) << x;
    }
    if (x > 0.31 && x < 0.5) {
      EXPECT_EQ(v, 0) << x;
    }
    if (std::abs(x - 0.2) < 0.004) {
      EXPECT_NEAR(v, 0.5, 0.1) << x;
    }
  }
}

TEST(Physics, PictureIsTheSumOfItsLayers) {
  support::Folder folder;
  const studio::Studio studio = support::ball_studio(folder.path(), 3);
  const auto geometry = twin::build_geometry(studio, {});
  ASSERT_TRUE(geometry) << core::to_string(geometry.problems());
  const View view = see(std::make_shared<const Tracer>(*geometry), studio.main_camera(), {64, 64});
  twin::Scene scene = twin::lit_by(studio, *geometry, studio::placed_rig(studio));
  scene.levels = {0.7, 0.2, 0.4};
  std::vector<core::Layer> layers;
  for (const twin::Light& light : scene.lights)
    layers.push_back(layer(view, light, scene.exposure_gain));
  const core::Picture ambient = ambient_layer(view, scene.ambient_irradiance, scene.exposure_gain);
  const core::Picture sum = relit(layers, scene.levels, ambient);
  const core::Picture whole = picture(view, scene);
  double brightest = 0;
  for (std::size_t i = 0; i < sum.green.values.size(); ++i) {
    EXPECT_NEAR(sum.green.values[i], whole.green.values[i], 1e-5);
    brightest = std::max<double>(brightest, whole.green.values[i]);
  }
  EXPECT_GT(brightest, 0.1);
}

TEST(Physics, LayersAreLinearInTheLampsOutput) {
  const View view = card_view();
  const core::Layer one = layer(view, rectangle({0.5, -1, 0.5}, 100, 0.3, 0.3), 1);
  const core::Layer seven = layer(view, rectangle({0.5, -1, 0.5}, 700, 0.3, 0.3), 1);
  for (std::size_t i = 0; i < one.diffuse.red.values.size(); ++i)
    EXPECT_NEAR(seven.diffuse.red.values[i], 7 * one.diffuse.red.values[i],
                1e-5 * seven.diffuse.red.values[i]);
}

TEST(Physics, WorkIsCountedRayByRay) {
  const View view = card_view({}, {16, 16});
  const Work before = work_done();
  layer(view, point({0, -1, 0}, 1), 1);
  const Work after = work_done();
  EXPECT_EQ(after.layers - before.layers, 1u);
  EXPECT_EQ(after.shadow_rays - before.shadow_rays, view.buffer.samples());
  studio::Camera camera;
  camera.at = {0, -2, 0};
  see(view.tracer, camera, {10, 7});
  EXPECT_EQ(work_done().primary_rays - after.primary_rays, 70u);
}

}  // namespace
}  // namespace chiaro::render
