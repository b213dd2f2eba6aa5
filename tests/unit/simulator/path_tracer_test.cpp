// SPDX-License-Identifier: Apache-2.0
// The physics of the path tracer: energy is neither lost nor made, direct light equals the fast
// renderer's, bounced light what form factors say; and seeds give the same bits.
#include "simulator/path_tracer/path_tracer.h"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/twin/lights/light_model.h"
#include "simulator/path_tracer/light_sample.h"
#include "tests/support/meshes.h"

namespace chiaro::simulator {
namespace {

using core::Rgb;
using core::Vec3;
using Kind = studio::Optic::Kind;

twin::SurfaceMaterial grey(double albedo, float specular = 0) {
  twin::SurfaceMaterial material;
  material.diffuse = {albedo, albedo, albedo};
  material.specular = specular;
  return material;
}

studio::Camera camera(Vec3 at, Vec3 look_at, double fov_degrees) {
  studio::Camera out;
  out.at = at;
  out.look_at = look_at;
  out.vertical_fov = core::radians(fov_degrees);
  return out;
}

twin::Light light(Kind kind, Vec3 position, Vec3 target, double candela) {
  twin::Light out;
  out.kind = kind;
  out.position = position;
  out.direction = core::unit(target - position);
  const Vec3 level = core::cross(out.direction, Vec3{0, 0, 1});
  out.right = core::length(level) > 1e-6 ? core::unit(level) : Vec3{1, 0, 0};
  out.up = core::cross(out.right, out.direction);
  out.candela = candela;
  out.cos_beam = std::cos(core::radians(15));
  out.cos_field = std::cos(core::radians(25));
  return out;
}

twin::Light panel(Vec3 position, Vec3 target, double candela, double side) {
  twin::Light out = light(Kind::rectangle, position, target, candela);
  out.width = out.height = side;
  return out;
}

struct World {
  std::shared_ptr<const render::Tracer> tracer;
  twin::Scene scene;
  World(std::vector<twin::Mesh> meshes, twin::SurfaceMaterial material,
        std::vector<twin::Light> lights) {
    scene.geometry = support::geometry_of(std::move(meshes), material);
    tracer = std::make_shared<const render::Tracer>(scene.geometry);
    scene.levels.assign(lights.size(), 1);
    scene.lights = std::move(lights);
  }
};

TraceOptions quick(int samples, int bounces) {
  TraceOptions options;
  options.samples = samples;
  options.bounces = bounces;
  options.antialias = false;
  options.most_bounced = 0;
  return options;
}

double mean(const core::Plane& plane) {
  double sum = 0;
  for (const float v : plane.values) sum += v;
  return sum / static_cast<double>(plane.values.size());
}

World ball_before_wall(std::vector<twin::Light> lights, float specular = 0) {
  return World(
      {support::icosphere({0, 0, 1}, 0.3, 4), support::card({0, 1.2, 1}, {3, 0, 0}, {0, 0, 3})},
      grey(0.5, specular), std::move(lights));
}
const studio::Camera kFront = camera({0, -3, 1}, {0, 0, 1}, 25);

TEST(PathTracer, WhiteFurnaceGivesBackExactlyItsLight) {
  // White surfaces under even light from everywhere cannot be told from it, however they face.
  World world({support::card({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
               support::card({0, 1, 1}, {1, 0, 0}, {0, 0, 1})},
              grey(1), {});
  world.scene.ambient_irradiance = {0.25, 0.5, 1};
  world.scene.exposure_gain = 0.8;
  const Traced seen = trace(*world.tracer, world.scene, camera({0, -2, 1.5}, {0, 0.6, 0.3}, 15),
                            {16, 12}, quick(32, 1000));
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(seen.picture.at(x, y).r, 0.2, 1e-6);
      EXPECT_NEAR(seen.picture.at(x, y).b, 0.8, 1e-6);
    }
}

TEST(PathTracer, IntegratingSphereMultipliesByOneOverOneMinusAlbedo) {
  const double albedo = 0.6, radius = 2, candela = 100;
  World world({support::icosphere({0, 0, 0}, radius, 4)}, grey(albedo),
              {light(Kind::point, {0, 0, 0}, {0, 1, 0}, candela)});
  world.scene.exposure_gain = 0.01;
  const Traced seen = trace(*world.tracer, world.scene, camera({0.3, -0.5, 0}, {0, 2, 0.4}, 40),
                            {24, 24}, quick(64, 1000));
  const double direct = candela / (radius * radius);
  const double expected = 0.01 * albedo * direct / (1 - albedo);
  EXPECT_NEAR(mean(seen.picture.green) / expected, 1, 0.01);
}

TEST(PathTracer, DirectLightAloneEqualsTheFastRenderer) {
  const Vec3 ball{0, 0, 1};
  twin::Light sun = light(Kind::directional, {0, 0, 0}, {0.5, 1, -0.8}, 0.5);
  twin::Light disk = light(Kind::disk, {1.5, -1.5, 1.8}, ball, 2);
  disk.radius = 0.3;
  const std::vector<twin::Light> lights{light(Kind::point, {-1.2, -1.6, 2}, ball, 3),
                                        light(Kind::spot, {0.2, -2, 2.5}, ball, 3), sun, disk,
                                        panel({-1.5, -1.2, 1.4}, ball, 3, 0.6)};
  for (const twin::Light& each : lights) {
    World world = ball_before_wall({each}, 0.3f);
    const core::Size size{96, 72};
    const Traced ours = trace(*world.tracer, world.scene, kFront, size, quick(144, 0));
    const core::Picture fast =
        render::picture(render::see(world.tracer, kFront, size), world.scene);
    double difference = 0;
    for (std::size_t i = 0; i < fast.green.values.size(); ++i)
      difference += std::abs(fast.green.values[i] - ours.picture.green.values[i]);
    difference /= static_cast<double>(fast.green.values.size());
    const double level = mean(fast.green);
    EXPECT_GT(level, 0.01);
    EXPECT_LT(difference / level, 0.012) << "light kind " << static_cast<int>(each.kind);
    EXPECT_NEAR(mean(ours.picture.green) / level, 1, 0.004)
        << "light kind " << static_cast<int>(each.kind);
  }
}

TEST(PathTracer, AmbientWithoutBouncesIsFlatAsInTheFastRenderer) {
  World world = ball_before_wall({});
  world.scene.ambient_irradiance = {0.3, 0.4, 0.5};
  const Traced ours = trace(*world.tracer, world.scene, kFront, {32, 24}, quick(2, 0));
  const core::Picture fast =
      render::picture(render::see(world.tracer, kFront, {32, 24}), world.scene);
  for (std::size_t i = 0; i < fast.blue.values.size(); ++i)
    EXPECT_NEAR(ours.picture.blue.values[i], fast.blue.values[i], 1e-6);
}

TEST(PathTracer, TwiceTheDistanceGivesAQuarter) {
  const auto at = [](double distance) {
    World world({support::card({0, 0, 0}, {0.05, 0, 0}, {0, 0.05, 0})}, grey(1),
                {light(Kind::point, {0, 0, distance}, {0, 0, 0}, 1)});
    return trace(*world.tracer, world.scene, camera({0, -1, 1}, {0, 0, 0}, 0.5), {1, 1},
                 quick(1, 3))
        .picture.at(0, 0)
        .g;
  };
  EXPECT_NEAR(at(1.5) / at(3), 4, 1e-3);
}

TEST(PathTracer, RandomPointsOfAFaceAverageToItsClosedForm) {
  const twin::Light soft = panel({0.4, -0.8, 1.1}, {0, 0, 0}, 10, 0.7);
  const Vec3 normal = core::unit(Vec3{0.1, -0.5, 0.8});
  core::Random random(3);
  double sum = 0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    const LightSample one = sample(soft, {0, 0, 0}, random.uniform(), random.uniform());
    sum += one.lux * std::max(0.0, core::dot(normal, one.towards)) / n;
  }
  EXPECT_NEAR(sum / twin::light_model(Kind::rectangle).irradiance(soft, {0, 0, 0}, normal), 1,
              0.01);
}

TEST(PathTracer, LightBouncedBetweenPlanesIsWhatTheirFormFactorSays) {
  // A floor lit straight from above lights a wall that the lamp only grazes: E on the wall is the
  // floor's radiosity times the form factor, integrated here by brute force.
  const double floor_half = 0.5, height = 0.3, albedo = 0.5, sun_lux = 2;
  twin::Light sun = light(Kind::directional, {0, 0, 5}, {0, 0, 0}, sun_lux);
  World world({support::card({0, -floor_half, 0}, {floor_half, 0, 0}, {0, floor_half, 0}),
               support::card({0, 1e-4, 0.5}, {0.5, 0, 0}, {0, 0, 0.5})},
              grey(albedo), {sun});
  const Traced seen = trace(*world.tracer, world.scene,
                            camera({0, -2, 0.6}, {0, 1e-4, height}, 0.2), {8, 8}, quick(512, 1));
  double form = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (2 * (i + 0.5) / n - 1) * floor_half, y = 2 * (j + 0.5) / n * floor_half;
      const double dd = x * x + y * y + height * height;
      const double area = (2 * floor_half / n) * (2 * floor_half / n);
      form += y * height / (core::kPi * dd * dd) * area;
    }
  EXPECT_GT(form, 0.1);
  EXPECT_NEAR(mean(seen.picture.green) / (albedo * albedo * sun_lux * form), 1, 0.02);
  const Traced direct = trace(*world.tracer, world.scene,
                              camera({0, -2, 0.6}, {0, 1e-4, height}, 0.2), {8, 8}, quick(4, 0));
  EXPECT_NEAR(mean(direct.picture.green), 0, 1e-6);
}

TEST(PathTracer, SameSeedSameBitsWhateverTheThreads) {
  World world = ball_before_wall({panel({-1.5, -1.2, 1.8}, {0, 0, 1}, 3, 0.6)});
  TraceOptions options = quick(6, 4);
  options.antialias = true;
  options.threads = 1;
  const Traced one = trace(*world.tracer, world.scene, kFront, {48, 36}, options);
  options.threads = 2;
  const Traced two = trace(*world.tracer, world.scene, kFront, {48, 36}, options);
  EXPECT_EQ(one.picture.red.values, two.picture.red.values);
  EXPECT_EQ(one.error.values, two.error.values);
  options.seed = 2;
  const Traced other = trace(*world.tracer, world.scene, kFront, {48, 36}, options);
  EXPECT_NE(one.picture.red.values, other.picture.red.values);
}

TEST(PathTracer, LayersMixToThePictureAtTheScenesLevels) {
  World world = ball_before_wall({panel({-1.5, -1.2, 1.8}, {0, 0, 1}, 3, 0.6),
                                  light(Kind::point, {1.5, -1, 1.2}, {0, 0, 1}, 2),
                                  light(Kind::point, {0, -2, 3}, {0, 0, 1}, 5)});
  world.scene.levels = {0.4, 0.7, 0};
  world.scene.ambient_irradiance = {0.05, 0.05, 0.1};
  const TracedLayers layers =
      trace_layers(*world.tracer, world.scene, kFront, {32, 24}, quick(8, 4));
  const core::Picture mix = mixed(layers, world.scene.levels);
  const Traced whole = trace(*world.tracer, world.scene, kFront, {32, 24}, quick(8, 4));
  for (std::size_t i = 0; i < mix.blue.values.size(); ++i)
    EXPECT_NEAR(mix.blue.values[i], whole.picture.blue.values[i], 1e-5);
  EXPECT_GT(mean(layers.lights[2].green), 0.05);  // dark in the scene, yet its layer is there
}

TEST(PathTracer, SaysHowMuchNoiseIsLeft) {
  World world = ball_before_wall({panel({-1.5, -1.2, 1.8}, {0, 0, 1}, 3, 0.9)});
  const core::Size size{40, 30};
  const Traced rough = trace(*world.tracer, world.scene, kFront, size, quick(16, 4));
  TraceOptions patient = quick(1024, 4);
  patient.seed = 9;
  const core::Plane truth =
      core::luminance(trace(*world.tracer, world.scene, kFront, size, patient).picture);
  const core::Plane seen = core::luminance(rough.picture);
  double sum = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    const double d = seen.values[i] - truth.values[i];
    sum += d * d;
  }
  const double actual = std::sqrt(sum / static_cast<double>(truth.values.size()));
  EXPECT_LT(actual, 1.1 * rough.noise);  // even samples do better than the independent ones assumed
  EXPECT_GT(actual, 0.2 * rough.noise);
  const Traced finer = trace(*world.tracer, world.scene, kFront, size, quick(64, 4));
  EXPECT_NEAR(finer.noise / rough.noise, 0.5, 0.06);
}

TEST(PathTracer, ClipsSpecksOfBouncedLightOnly) {
  World world = ball_before_wall({light(Kind::point, {0, 1.19, 1.6}, {0, 0, 1}, 1)});
  TraceOptions options = quick(32, 4);
  const Traced free = trace(*world.tracer, world.scene, kFront, {32, 24}, options);
  options.most_bounced = 0.5;
  const Traced clipped = trace(*world.tracer, world.scene, kFront, {32, 24}, options);
  EXPECT_LT(clipped.noise, free.noise);
  const core::Picture direct =
      trace(*world.tracer, world.scene, kFront, {32, 24}, quick(32, 0)).picture;
  for (std::size_t i = 0; i < direct.green.values.size(); ++i)
    EXPECT_GE(clipped.picture.green.values[i], direct.green.values[i] - 1e-4f);
}

TEST(PathTracer, StopsWhenAsked) {
  World world = ball_before_wall({panel({-1.5, -1.2, 1.8}, {0, 0, 1}, 3, 0.6)});
  std::atomic<bool> stop = false;
  int rows = 0;
  TraceOptions options = quick(2, 2);
  options.threads = 1;
  options.stop = &stop;
  options.progress = [&](double) { stop = ++rows == 5; };
  (void)trace(*world.tracer, world.scene, kFront, {32, 24}, options);
  EXPECT_EQ(rows, 5);
}

TEST(PathTracer, PixelsThatSeeNothingAreBlack) {
  World world({support::icosphere({0, 0, 1}, 0.1, 2)}, grey(0.5),
              {light(Kind::point, {0, -2, 2}, {0, 0, 1}, 5)});
  world.scene.ambient_irradiance = {1, 1, 1};
  const Traced seen = trace(*world.tracer, world.scene, kFront, {9, 9}, quick(4, 4));
  EXPECT_EQ(seen.picture.at(0, 0), (Rgb{0, 0, 0}));
  EXPECT_GT(seen.picture.at(4, 4).g, 0.1);
}

}  // namespace
}  // namespace chiaro::simulator
