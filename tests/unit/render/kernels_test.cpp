// SPDX-License-Identifier: Apache-2.0
// The vector kernels against the formulas they were made from, on every instruction set here.
#include "controller/render/kernels.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "controller/core/random.h"
#include "controller/twin/lights/light_model.h"

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

INSTANTIATE_TEST_SUITE_P(EveryLight, Kernels,
                         testing::ValuesIn(twin::light_models().begin(),
                                           twin::light_models().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

void blend(void*) {
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
  kernels::for_each_target(blend, nullptr);
}

void mix(void*) {
  std::vector<float> a(37, 1), b(37, 2), ambient(37, 0.5f), out(37);
  const float* planes[] = {a.data(), b.data()};
  const float levels[] = {0.25f, 2};
  kernels::mix(planes, levels, ambient.data(), out.data(), out.size());
  for (const float v : out) EXPECT_EQ(v, 4.75f);
}

TEST(KernelsMix, AddsAnyLengthOnEveryInstructionSet) { kernels::for_each_target(mix, nullptr); }

}  // namespace
}  // namespace chiaro::render
