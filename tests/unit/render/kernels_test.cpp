// SPDX-License-Identifier: Apache-2.0
// The vector kernels against the formulas they were made from, on every instruction set here.
#include "controller/render/kernels.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "controller/core/random.h"
#include "controller/measure/measure.h"
#include "controller/render/lighting.h"
#include "controller/twin/lights/light_model.h"
#include "tests/support/meshes.h"

namespace chiaro::render {
namespace {

using core::Vec3;

Vec3 direction(core::Random& random) {
  for (;;) {
    const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (length(v) > 0.1 && length(v) < 1) return unit(v);
  }
}

/// Samples anywhere about the origin, of every slant; two tiles, the second partly filled.
core::GBuffer scattered(std::size_t n) {
  core::Random random(5);
  core::GBuffer b;
  b.size = {static_cast<int>(n), 1};
  const auto push = [](std::vector<float>& x, std::vector<float>& y, std::vector<float>& z,
                       Vec3 v) {
    x.push_back(static_cast<float>(v.x));
    y.push_back(static_cast<float>(v.y));
    z.push_back(static_cast<float>(v.z));
  };
  for (std::size_t i = 0; i < n; ++i) {
    b.pixel.push_back(static_cast<std::uint32_t>(i));
    push(b.position_x, b.position_y, b.position_z,
         {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Vec3 normal = direction(random);
    push(b.normal_x, b.normal_y, b.normal_z, normal);
    push(b.face_x, b.face_y, b.face_z, normal);
    push(b.viewer_x, b.viewer_y, b.viewer_z, direction(random));
    push(b.diffuse_r, b.diffuse_g, b.diffuse_b, {0.2, 0.3, 0.4});
    b.specular.push_back(i % 3 == 0 ? 0.0f : 0.2f);
    b.shininess.push_back(static_cast<float>(random.uniform(2, 120)));
    b.depth.push_back(1);
    b.object.push_back(1);
  }
  return b;
}

twin::Light lamp(studio::Optic::Kind kind, studio::Optic::Attenuation law) {
  twin::Light light;
  light.kind = kind;
  light.attenuation = law;
  light.position = {0.3, -0.6, 1.7};
  light.direction = unit(Vec3{-0.2, 0.5, -1.4});
  light.right = unit(cross(light.direction, Vec3{0, 0, 1}));
  light.up = cross(light.right, light.direction);
  light.candela = 800;
  light.cos_beam = std::cos(core::radians(15));
  light.cos_field = std::cos(core::radians(30));
  light.width = 0.7;
  light.height = 1.0;
  light.radius = 0.45;
  return light;
}

struct Context {
  const core::GBuffer& buffer;
  const Samples& samples;
  twin::Light light;
  int runs = 0;
};

void compare(void* data) {
  auto& context = *static_cast<Context*>(data);
  ++context.runs;
  const core::GBuffer& b = context.buffer;
  const twin::LightModel& model = twin::light_model(context.light.kind);
  alignas(64) std::array<float, kTile> irradiance, glossy;
  for (std::size_t tile = 0; tile < context.samples.tiles(); ++tile) {
    kernels::shade(context.samples, context.light, tile, irradiance.data(), glossy.data());
    for (std::size_t k = 0; k < context.samples.in_tile(tile); ++k) {
      const std::size_t i = tile * kTile + k;
      const Vec3 at{b.position_x[i], b.position_y[i], b.position_z[i]};
      const Vec3 n{b.normal_x[i], b.normal_y[i], b.normal_z[i]};
      const Vec3 v{b.viewer_x[i], b.viewer_y[i], b.viewer_z[i]};
      const double head_on =
          model.parallel
              ? 800
              : 800 * twin::faded(context.light.attenuation, distance(at, context.light.position));
      EXPECT_NEAR(irradiance[k], model.irradiance(context.light, at, n),
                  (model.name == "spot" ? 1e-4 : 2e-5) * head_on)
          << model.name << " sample " << i;
      EXPECT_NEAR(glossy[k],
                  b.specular[i] * model.specular(context.light, at, n, v, b.shininess[i]),
                  1e-4 * head_on)
          << model.name << " sample " << i;
    }
  }
}

class Kernels : public testing::TestWithParam<twin::LightModel> {};

TEST_P(Kernels, EqualTheFormulasOnEveryInstructionSet) {
  const core::GBuffer buffer = scattered(1500);
  const Samples samples(buffer);
  for (const auto law : {studio::Optic::Attenuation::inverse_square,
                         studio::Optic::Attenuation::linear, studio::Optic::Attenuation::none}) {
    Context context{buffer, samples, lamp(GetParam().kind, law)};
    kernels::for_each_target(compare, &context);
    EXPECT_GE(context.runs, 1);
  }
}

/// A wall at y = 2 photographed in rows, and a ball's worth of normals before it, softly glossy.
core::GBuffer wall_and_ball() {
  core::Random random(11);
  core::GBuffer b;
  b.size = {64, 32};
  const auto push = [](std::vector<float>& x, std::vector<float>& y, std::vector<float>& z,
                       Vec3 v) {
    x.push_back(static_cast<float>(v.x));
    y.push_back(static_cast<float>(v.y));
    z.push_back(static_cast<float>(v.z));
  };
  for (std::size_t i = 0; i < b.size.pixels(); ++i) {
    const int x = static_cast<int>(i % 64), y = static_cast<int>(i / 64);
    const bool ball = x >= 24 && x < 40;
    const Vec3 normal = ball ? direction(random) : Vec3{0, -1, 0};
    const Vec3 at = ball ? 0.15 * normal : Vec3{0.01 * (x - 32), 2, 0.01 * (16 - y)};
    b.pixel.push_back(static_cast<std::uint32_t>(i));
    push(b.position_x, b.position_y, b.position_z, at);
    push(b.normal_x, b.normal_y, b.normal_z, normal);
    push(b.face_x, b.face_y, b.face_z, normal);
    push(b.viewer_x, b.viewer_y, b.viewer_z, unit(Vec3{0, -2.6, 0.2} - at));
    push(b.diffuse_r, b.diffuse_g, b.diffuse_b, {0.4, 0.4, 0.4});
    b.specular.push_back(ball ? 0.2f : 0.0f);
    b.shininess.push_back(static_cast<float>(random.uniform(8, 40)));
    b.depth.push_back(1);
    b.object.push_back(ball ? 2 : 1);
  }
  return b;
}

TEST(Samples, KnowStraightLinesOfWallsFromTheSubject) {
  const core::GBuffer buffer = wall_and_ball();
  const Samples samples(buffer);
  // Of each row's four groups the second and third hold the ball.
  for (std::size_t tile = 0; tile < samples.tiles(); ++tile) {
    const Samples::Lines lines = samples.lines(tile);
    EXPECT_EQ(lines.groups, 0x9999999999999999u);
    EXPECT_EQ(lines.count, 32u);
    EXPECT_NEAR(lines.longest, 0.15, 1e-4);
  }
}

struct Quick {
  const core::GBuffer& buffer;
  const Samples& samples;
  twin::Light light;
  int runs = 0;
};

/// Against a dense sum over the face, of what the lamp gives head on.
void compare_quick(void* data) {
  auto& context = *static_cast<Quick*>(data);
  ++context.runs;
  const core::GBuffer& b = context.buffer;
  const twin::LightModel& model = twin::light_model(context.light.kind);
  alignas(64) std::array<float, kTile> irradiance, glossy;
  double squares = 0, count = 0;
  for (std::size_t tile = 0; tile < context.samples.tiles(); ++tile) {
    ASSERT_TRUE(kernels::shade_face_quickly(context.samples, context.light, tile, nullptr,
                                            irradiance.data(), glossy.data()));
    for (std::size_t k = 0; k < kTile; k += 3) {
      const std::size_t i = tile * kTile + k;
      const Vec3 at{b.position_x[i], b.position_y[i], b.position_z[i]};
      const Vec3 n{b.normal_x[i], b.normal_y[i], b.normal_z[i]};
      const Vec3 v{b.viewer_x[i], b.viewer_y[i], b.viewer_z[i]};
      const double d = distance(at, context.light.position);
      const double head_on = 800 * twin::faded(context.light.attenuation, d);
      EXPECT_NEAR(irradiance[k] / head_on, model.irradiance(context.light, at, n) / head_on, 4e-3)
          << model.name << " sample " << i;
      double shine = 0;
      constexpr int kAcross = 12;
      for (int s = 0; s < kAcross * kAcross; ++s) {
        const Vec3 to = model.target(context.light, at, (s % kAcross + 0.5) / kAcross,
                                     (s / kAcross + 0.5) / kAcross) -
                        at;
        const double far = length(to);
        shine += std::max(0.0, -dot(context.light.direction, to) / far) *
                 twin::faded(context.light.attenuation, far) *
                 twin::highlight(n, to / far, v, b.shininess[i]);
      }
      const double off =
          (glossy[k] - b.specular[i] * 800 * shine / (kAcross * kAcross)) / (0.2 * head_on);
      squares += off * off, ++count;
      EXPECT_NEAR(off, 0, 0.1) << model.name << " sample " << i;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.01) << model.name;
}

TEST(QuickKernels, StayNearTheTruthOnEveryInstructionSet) {
  const core::GBuffer buffer = wall_and_ball();
  const Samples samples(buffer);
  for (const auto kind : {studio::Optic::Kind::rectangle, studio::Optic::Kind::disk})
    for (const auto law : {studio::Optic::Attenuation::inverse_square,
                           studio::Optic::Attenuation::linear, studio::Optic::Attenuation::none})
      for (const Vec3 at : {Vec3{-0.9, -1.0, 0.8}, Vec3{0.4, -1.9, 0.2}, Vec3{1.4, 0.6, 0.9}}) {
        Quick context{buffer, samples, lamp(kind, law)};
        twin::Light& light = context.light;
        light.position = at;
        light.direction = unit(-1.0 * at);
        light.right = unit(cross(light.direction, Vec3{0, 0, 1}));
        light.up = cross(light.right, light.direction);
        light.width = 0.6, light.height = 0.9, light.radius = 0.4;
        kernels::for_each_target(compare_quick, &context);
        EXPECT_GE(context.runs, 1);
      }
}

TEST(QuickKernels, LeaveNearAndSharpToTheClosedForms) {
  core::GBuffer buffer = wall_and_ball();
  alignas(64) std::array<float, kTile> irradiance, glossy;
  twin::Light light = lamp(studio::Optic::Kind::rectangle, {});
  light.position = {0, -0.9, 0};
  light.direction = {0, 1, 0};
  const auto quick = [&] {
    return kernels::shade_face_quickly(Samples(buffer), light, 0, nullptr, irradiance.data(),
                                       glossy.data());
  };
  EXPECT_FALSE(quick());
  light.position = {0, -1.9, 0};
  EXPECT_TRUE(quick());
  std::fill(buffer.shininess.begin(), buffer.shininess.end(), 90.0f);
  EXPECT_FALSE(quick());
}

TEST(QuickKernels, MayLeaveOutWhatNothingIsSeenOf) {
  const core::GBuffer buffer = wall_and_ball();
  const Samples samples(buffer);
  alignas(64) std::array<float, kTile> all, some, glossy, visible;
  for (std::size_t i = 0; i < kTile; ++i) visible[i] = i % 64 < 32 ? 0.0f : 0.5f;
  twin::Light light = lamp(studio::Optic::Kind::rectangle, {});
  light.position = {0, -1.9, 0};
  light.direction = {0, 1, 0};
  kernels::shade(samples, light, 0, all.data(), glossy.data(), Shading::quick);
  kernels::shade(samples, light, 0, some.data(), glossy.data(), Shading::quick, visible.data());
  for (std::size_t i = 0; i < kTile; ++i)
    if (visible[i] > 0) {
      EXPECT_EQ(some[i], all[i]) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(EveryLight, Kernels,
                         testing::ValuesIn(twin::light_models().begin(),
                                           twin::light_models().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

void blend(void* runs) {
  ++*static_cast<int*>(runs);
  std::vector<std::uint8_t> bits(64 / 8 + 8, 0), bytes(64 + 16, 0);
  for (std::size_t i = 0; i < 64; ++i) {
    if (i % 5 == 0) bits[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    bytes[i] = static_cast<std::uint8_t>(4 * i);
  }
  std::array<float, 64> out;
  const kernels::Bits two[] = {{bits.data(), 0.25f}, {bits.data(), 0.5f}};
  kernels::blend_bits(two, out.data(), 64);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(out[i], i % 5 == 0 ? 0.75f : 0.0f) << i;
  const kernels::Bytes one[] = {{bytes.data(), 0.5f}};
  kernels::blend_bytes(one, out.data(), 64);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(out[i], 0.5 * 4 * static_cast<double>(i) / 255, 1e-6) << i;
}

TEST(KernelsBlend, WeighsBitsAndBytesOnEveryInstructionSet) {
  int runs = 0;
  kernels::for_each_target(blend, &runs);
  EXPECT_GE(runs, 1);
}

void mix(void* runs) {
  ++*static_cast<int*>(runs);
  std::vector<float> a(37, 1), b(37, 2), ambient(37, 0.5f), out(37);
  const float* planes[] = {a.data(), b.data()};
  const float levels[] = {0.25f, 2};
  kernels::mix(planes, levels, ambient.data(), out.data(), out.size());
  for (const float v : out) EXPECT_EQ(v, 4.75f);
}

TEST(KernelsMix, AddsAnyLengthOnEveryInstructionSet) {
  int runs = 0;
  kernels::for_each_target(mix, &runs);
  EXPECT_GE(runs, 1);
}

/// What the design engine makes of one lamp and measures of it.
struct WholePictures {
  const View& view;
  std::vector<twin::Light> lights;
  std::vector<core::Plane> first;  ///< of the first instruction set
  std::vector<measure::Components> measured;
  int sets = 0;
};

void compare_pictures(void* data) {
  auto& all = *static_cast<WholePictures*>(data);
  const measure::PixelMap map = measure::pixel_map(core::planes(all.view.buffer));
  std::size_t k = 0;
  for (const twin::Light& light : all.lights)
    for (const Shading shading : {Shading::exact, Shading::quick}) {
      core::Plane picture;
      const Traced traced(all.view, light, kCached);
      luminance(all.view, light, 1e-3, &traced, picture, shading);
      const auto now = measure::components_of_luminance(picture, map);
      if (all.sets == 0) {
        all.first.push_back(picture);
        all.measured.push_back(now);
        continue;
      }
      double most = 0, off = 0;
      for (std::size_t i = 0; i < picture.values.size(); ++i) {
        most = std::max(most, std::abs(static_cast<double>(all.first[k].values[i])));
        off = std::max(off, std::abs(static_cast<double>(picture.values[i]) -
                                     static_cast<double>(all.first[k].values[i])));
      }
      EXPECT_LE(off, 2e-4 * most) << "a twentieth of an 8-bit step: highlights' powers differ so";
      const measure::Components& then = all.measured[k++];
      EXPECT_NEAR(now.mean, then.mean, 1e-2);
      EXPECT_NEAR(now.gradient, then.gradient, 1e-2);
      EXPECT_NEAR(now.variance, then.variance, 1e-2);
      EXPECT_NEAR(now.contrast, then.contrast, 1e-3);
      EXPECT_NEAR(now.edge, then.edge, 1e-2);
    }
  ++all.sets;
}

TEST(KernelsTogether, GiveTheSamePictureAndTheSameMeasuresOnEveryInstructionSet) {
  const support::Folder folder;
  const studio::Studio studio = support::ball_studio(folder.path(), 3);
  const auto geometry = twin::build_geometry(studio, {});
  ASSERT_TRUE(geometry);
  const View view = see(std::make_shared<Tracer>(*geometry), studio.main_camera(), {64, 64});
  const twin::Scene scene = twin::lit_by(studio, *geometry, studio::placed_rig(studio));
  WholePictures all{view, scene.lights, {}, {}, 0};
  kernels::for_each_target(compare_pictures, &all);
  EXPECT_GE(all.sets, 2) << "this processor knows one instruction set only?";
}

}  // namespace
}  // namespace chiaro::render
