// SPDX-License-Identifier: Apache-2.0
#include "controller/core/colour.h"

#include <algorithm>
#include <cmath>

namespace chiaro::core {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr Matrix3 kXyzFromRgb{{{0.4123907993, 0.3575843394, 0.1804807884},
                               {0.2126390059, 0.7151686788, 0.0721923154},
                               {0.0193308187, 0.1191947798, 0.9505321522}}};
constexpr Matrix3 kRgbFromXyz{{{3.2409699419, -1.5373831776, -0.4986107603},
                               {-0.9692436363, 1.8759675015, 0.0415550574},
                               {0.0556300797, -0.2039769589, 1.0569715142}}};
constexpr Matrix3 kBradford{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
constexpr Matrix3 kBradfordInverse{{{0.9869929, -0.1470543, 0.1599627},
                                    {0.4323053, 0.5183603, 0.0492912},
                                    {-0.0085287, 0.0400428, 0.9684867}}};
constexpr Chromaticity kD65{0.3127, 0.3290};

std::array<double, 3> times(const Matrix3& m, std::array<double, 3> v) {
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Xyz xyz_of(Chromaticity c) { return {c.x / c.y, 1.0, (1 - c.x - c.y) / c.y}; }

/// Kim et al. 2002, cubic fit of the Planckian locus.
Chromaticity planckian(double t) {
  const double i = 1e3 / t;
  const double x = t <= 4000 ? ((-0.2661239 * i - 0.2343589) * i + 0.8776956) * i + 0.179910
                             : ((-3.0258469 * i + 2.1070379) * i + 0.2226347) * i + 0.240390;
  const double y = t <= 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : t <= 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                               : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return {x, y};
}

/// CIE 15, daylight locus.
Chromaticity daylight(double t) {
  const double i = 1e3 / t;
  const double x = t <= 7000 ? ((-4.6070 * i + 2.9678) * i + 0.09911) * i + 0.244063
                             : ((-2.0064 * i + 1.9018) * i + 0.24748) * i + 0.237040;
  return {x, -3.000 * x * x + 2.870 * x - 0.275};
}

Chromaticity shifted_by_duv(Chromaticity c, Chromaticity warmer, double duv) {
  // Duv is measured across the locus in CIE 1960 uv.
  const auto uv = [](Chromaticity p) {
    const double d = -2 * p.x + 12 * p.y + 3;
    return std::array<double, 2>{4 * p.x / d, 6 * p.y / d};
  };
  const auto a = uv(c), b = uv(warmer);
  const double du = b[0] - a[0], dv = b[1] - a[1], l = std::hypot(du, dv);
  const double u = a[0] - duv * dv / l, v = a[1] + duv * du / l;
  const double d = 2 * u - 8 * v + 4;
  return {3 * u / d, 2 * v / d};
}

Chromaticity locus(double t) {
  if (t <= 4000) return planckian(t);
  if (t >= 5000) return daylight(t);
  const double w = (t - 4000) / 1000;
  const Chromaticity p = planckian(t), d = daylight(t);
  return {(1 - w) * p.x + w * d.x, (1 - w) * p.y + w * d.y};
}

}  // namespace

double srgb_encoded(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

double srgb_linear(double encoded) {
  const double v = std::clamp(encoded, 0.0, 1.0);
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

namespace {
constexpr double kEpsilon = 216.0 / 24389.0, kKappa = 24389.0 / 27.0;
double lab_curve(double t) { return t > kEpsilon ? std::cbrt(t) : (kKappa * t + 16) / 116; }
}  // namespace

double lightness(double y) { return y <= 0 ? 0 : 116 * lab_curve(y) - 16; }

double luminance_of_lightness(double l) {
  if (l <= 0) return 0;
  if (l <= kKappa * kEpsilon) return l / kKappa;
  const double f = (l + 16) / 116;
  return f * f * f;
}

Xyz xyz_of(Rgb c) {
  const auto v = times(kXyzFromRgb, {c.r, c.g, c.b});
  return {v[0], v[1], v[2]};
}

Rgb rgb_of(Xyz c) {
  const auto v = times(kRgbFromXyz, {c.x, c.y, c.z});
  return {v[0], v[1], v[2]};
}

Lab lab_of(Rgb linear) {
  const Xyz c = xyz_of(linear), white = xyz_of(kD65);
  const double fx = lab_curve(std::max(0.0, c.x / white.x)), fy = lab_curve(std::max(0.0, c.y)),
               fz = lab_curve(std::max(0.0, c.z / white.z));
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Chromaticity white_chromaticity(Kelvin cct, double tint) {
  const double t = std::clamp(cct.value, 1000.0, 25000.0);
  const Chromaticity c = locus(t);
  if (tint == 0) return c;
  return shifted_by_duv(c, locus(t * 0.999), tint * 1e-3);
}

Rgb coloured_light(Chromaticity chromaticity, Kelvin balance) {
  const Xyz light = xyz_of(chromaticity), white = xyz_of(white_chromaticity(balance)),
            target = xyz_of(kD65);
  auto cone = times(kBradford, {light.x, light.y, light.z});
  const auto from = times(kBradford, {white.x, white.y, white.z});
  const auto to = times(kBradford, {target.x, target.y, target.z});
  for (std::size_t i = 0; i < 3; ++i) cone[i] *= to[i] / from[i];
  const auto xyz = times(kBradfordInverse, cone);
  Rgb rgb = rgb_of(Xyz{xyz[0], xyz[1], xyz[2]});
  rgb = {std::max(0.0, rgb.r), std::max(0.0, rgb.g), std::max(0.0, rgb.b)};
  return (1.0 / luminance(rgb)) * rgb;
}

Rgb white_light(Kelvin cct, double tint, Kelvin balance) {
  if (cct == balance && tint == 0) return {1, 1, 1};  // exact, not to the matrices' rounding
  return coloured_light(white_chromaticity(cct, tint), balance);
}

}  // namespace chiaro::core
