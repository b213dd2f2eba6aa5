// SPDX-License-Identifier: Apache-2.0
// What every kind of light must keep to, whatever its shape: over each line of lights.def.
#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/random.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

using core::Vec3;
using studio::Optic;

/// A lamp of that kind, 2 m up, shining down on the origin: 0.5 x 0.8 m or 0.3 m where it has size.
Light lamp(Optic::Kind kind, Optic::Attenuation law = Optic::Attenuation::inverse_square) {
  Light light;
  light.kind = kind;
  light.attenuation = law;
  light.position = {0, 0, 2};
  light.direction = {0, 0, -1};
  light.right = {1, 0, 0};
  light.up = {0, 1, 0};
  light.candela = 500;
  light.cos_beam = std::cos(core::radians(20));
  light.cos_field = std::cos(core::radians(35));
  light.width = 0.5;
  light.height = 0.8;
  light.radius = 0.3;
  return light;
}

class Lights : public testing::TestWithParam<LightModel> {
 protected:
  Vec3 anywhere(core::Random& random, double reach) const {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach),
            random.uniform(-reach, reach)};
  }
};

TEST_P(Lights, AreListedUnderTheirKind) {
  EXPECT_EQ(&light_model(GetParam().kind), &light_model(light_model(GetParam().kind).kind));
  EXPECT_EQ(light_model(GetParam().kind).name, GetParam().name);
  EXPECT_FALSE(GetParam().summary.empty());
}

TEST_P(Lights, AreFiniteAndNeverNegativeAnywhere) {
  core::Random random(3);
  const Light light = lamp(GetParam().kind);
  std::vector<Vec3> places{
      light.position, light.position + Vec3{0, 0, -1e-9}, {0, 0, 2.5}, {0.25, 0.4, 2}, {1e4, 0, 0}};
  for (int i = 0; i < 2000; ++i) places.push_back(anywhere(random, 4));
  for (const Vec3 at : places) {
    const Vec3 normal = unit(anywhere(random, 1)), viewer = unit(anywhere(random, 1));
    const double e = GetParam().irradiance(light, at, normal);
    const double s = GetParam().specular(light, at, normal, viewer, random.uniform(1, 200));
    EXPECT_TRUE(std::isfinite(e) && e >= 0) << e;
    EXPECT_TRUE(std::isfinite(s) && s >= 0) << s;
  }
}

TEST_P(Lights, GiveNothingToASurfaceThatFacesAway) {
  const Light light = lamp(GetParam().kind);
  EXPECT_EQ(GetParam().irradiance(light, {}, {0, 0, -1}), 0);
  EXPECT_EQ(GetParam().specular(light, {}, {0, 0, -1}, {0, 0, 1}, 20), 0);
}

TEST_P(Lights, AreLinearInTheirCandela) {
  Light light = lamp(GetParam().kind);
  const Vec3 at{0.3, -0.2, 0.1}, normal = unit(Vec3{0.2, 0.1, 1}), viewer = unit(Vec3{0, -1, 1});
  const double e = GetParam().irradiance(light, at, normal);
  const double s = GetParam().specular(light, at, normal, viewer, 24);
  ASSERT_GT(e, 0);
  ASSERT_GT(s, 0);
  light.candela *= 7;
  EXPECT_NEAR(GetParam().irradiance(light, at, normal), 7 * e, 1e-9 * e);
  EXPECT_NEAR(GetParam().specular(light, at, normal, viewer, 24), 7 * s, 1e-9 * s);
}

// [I-2]
TEST_P(Lights, FallWithDistanceAsTheirLawSays) {
  if (GetParam().parallel) return;  // it comes from everywhere alike
  const std::pair<Optic::Attenuation, double> laws[] = {{Optic::Attenuation::inverse_square, 2},
                                                        {Optic::Attenuation::linear, 1},
                                                        {Optic::Attenuation::none, 0}};
  for (const auto& [law, power] : laws) {
    const Light light = lamp(GetParam().kind, law);
    const double near = GetParam().irradiance(light, {0, 0, 2 - 20}, {0, 0, 1});
    const double far = GetParam().irradiance(light, {0, 0, 2 - 60}, {0, 0, 1});
    EXPECT_NEAR(near / far, std::pow(3, power), 1e-3 * std::pow(3, power)) << power;
    // From afar every kind is its candela at that distance.
    EXPECT_NEAR(near, light.candela / std::pow(20, power), 1e-3 * near) << power;
  }
}

TEST_P(Lights, EqualTheSumOverTheirFace) {
  if (!GetParam().has_area) return;
  const Light light = lamp(GetParam().kind);
  core::Random random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const Vec3 at{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1.4)};
    const Vec3 normal =
        unit(Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.3, 1)});
    constexpr int kAcross = 64;
    double sum = 0;
    for (int k = 0; k < kAcross * kAcross; ++k) {
      const Vec3 to = GetParam().target(light, at, (k % kAcross + 0.5) / kAcross,
                                        (k / kAcross + 0.5) / kAcross) -
                      at;
      const double d = length(to);
      sum += std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, light.direction)) /
             (d * d * d * d);
    }
    const double sampled = light.candela * sum / (kAcross * kAcross);
    const double head_on = light.candela / dot(light.position - at, light.position - at);
    EXPECT_NEAR(GetParam().irradiance(light, at, normal), sampled, 0.01 * head_on) << trial;
  }
}

TEST_P(Lights, HaveTheirShadowTargetsOnTheirFace) {
  const Light light = lamp(GetParam().kind);
  for (const double u : {0.0, 0.25, 0.5, 0.99})
    for (const double v : {0.0, 0.5, 0.75}) {
      const Vec3 target = GetParam().target(light, {}, u, v);
      if (GetParam().parallel) {
        EXPECT_NEAR(angle_between(target, -light.direction), 0, 1e-9);
      } else if (GetParam().has_area) {
        EXPECT_NEAR(target.z, 2, 1e-12);
        EXPECT_LE(length(target - light.position), 0.5);
      } else {
        EXPECT_EQ(target, light.position);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryLine, Lights,
                         testing::ValuesIn(light_models().begin(), light_models().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(RectangleLight, OnItsAxisHasTheClosedForm) {
  // E = 4 L / 2 [a/sqrt(a2+d2) atan(b/sqrt(a2+d2)) + b/sqrt(b2+d2) atan(a/sqrt(b2+d2))], a, b the
  // half sides.
  const Light light = lamp(Optic::Kind::rectangle);
  const double a = 0.25, b = 0.4, d = 2, luminance = 500 / (0.5 * 0.8);
  const double ra = std::hypot(a, d), rb = std::hypot(b, d);
  const double expected = 2 * luminance * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
  EXPECT_NEAR(light_model(light.kind).irradiance(light, {}, {0, 0, 1}), expected, 1e-9 * expected);
}

TEST(DiskLight, OnItsAxisHasTheClosedForm) {
  const Light light = lamp(Optic::Kind::disk);
  // E = pi L r2 / (r2 + d2) = I / (r2 + d2)
  EXPECT_NEAR(light_model(light.kind).irradiance(light, {}, {0, 0, 1}), 500 / (0.09 + 4), 1e-9);
}

}  // namespace
}  // namespace chiaro::twin
