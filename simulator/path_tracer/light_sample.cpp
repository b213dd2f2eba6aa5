// SPDX-License-Identifier: Apache-2.0
#include "simulator/path_tracer/light_sample.h"

#include <algorithm>
#include <cmath>

namespace chiaro::simulator {
namespace {

using core::Vec3;
using Kind = studio::Optic::Kind;
using Attenuation = studio::Optic::Attenuation;

/// Far beyond any studio: shadow rays to a sun go this far.
constexpr double kFar = 1000;

Vec3 point_of(const twin::Light& light, double u, double v) {
  switch (light.kind) {
    case Kind::rectangle:
      return light.position + ((u - 0.5) * light.width) * light.right +
             ((v - 0.5) * light.height) * light.up;
    case Kind::disk: {
      const double r = light.radius * std::sqrt(u), turn = 2 * core::kPi * v;
      return light.position + (r * std::cos(turn)) * light.right + (r * std::sin(turn)) * light.up;
    }
    default:
      return light.position;
  }
}

double attenuated(const twin::Light& light, double d) {
  switch (light.attenuation) {
    case Attenuation::inverse_square:
      return light.candela / (d * d);
    case Attenuation::linear:
      return light.candela / d;
    case Attenuation::none:
      return light.candela;
  }
  return 0;
}

/// Share of the on-axis intensity that leaves at this angle off the axis.
double beam(const twin::Light& light, double cosine) {
  if (light.kind == Kind::rectangle || light.kind == Kind::disk) return std::max(0.0, cosine);
  if (light.kind != Kind::spot) return 1;
  const double span = light.cos_beam - light.cos_field;
  if (span <= 0) return cosine >= light.cos_beam ? 1 : 0;
  const double t = std::clamp((cosine - light.cos_field) / span, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

LightSample sample(const twin::Light& light, Vec3 at, double u, double v) {
  if (light.kind == Kind::directional)
    return {at - kFar * light.direction, -light.direction, light.candela};
  LightSample found;
  found.from = point_of(light, u, v);
  const Vec3 way = found.from - at;
  const double d = core::length(way);
  if (d <= 0) return found;
  found.towards = way / d;
  found.lux = attenuated(light, d) * beam(light, -core::dot(found.towards, light.direction));
  return found;
}

}  // namespace chiaro::simulator
