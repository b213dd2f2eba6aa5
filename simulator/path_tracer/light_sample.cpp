// SPDX-License-Identifier: Apache-2.0
#include "simulator/path_tracer/light_sample.h"

#include <algorithm>

#include "controller/twin/lights/light_model.h"

namespace chiaro::simulator {
namespace {

using core::Vec3;
using Kind = studio::Optic::Kind;

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
  LightSample found;
  found.from = twin::light_model(light.kind).target(light, at, u, v);
  const Vec3 way = found.from - at;
  const double d = core::length(way);
  if (d <= 0) return found;
  found.towards = way / d;
  found.lux = light.candela;
  if (light.kind != Kind::directional)
    found.lux *=
        twin::faded(light.attenuation, d) * beam(light, -core::dot(found.towards, light.direction));
  return found;
}

}  // namespace chiaro::simulator
