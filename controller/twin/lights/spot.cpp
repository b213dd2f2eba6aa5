// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

/// Candela towards a direction leaving the lamp: full within the beam, none beyond the field,
/// smoothstep in the cosine between.
double towards(const Light& light, core::Vec3 leaving) {
  const double cosine = dot(light.direction, leaving);
  const double width = light.cos_beam - light.cos_field;
  const double t = width > 1e-9 ? std::clamp((cosine - light.cos_field) / width, 0.0, 1.0)
                                : (cosine >= light.cos_beam ? 1.0 : 0.0);
  return light.candela * t * t * (3 - 2 * t);
}

double irradiance(const Light& light, core::Vec3 at, core::Vec3 normal) {
  const core::Vec3 to = light.position - at;
  const core::Vec3 direction = unit(to);
  return towards(light, -direction) * faded(light.attenuation, length(to)) *
         std::max(0.0, dot(normal, direction));
}

double specular(const Light& light, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                double shininess) {
  const core::Vec3 to = light.position - at;
  const core::Vec3 direction = unit(to);
  return towards(light, -direction) * faded(light.attenuation, length(to)) *
         highlight(normal, direction, viewer, shininess);
}

core::Vec3 target(const Light& light, core::Vec3, double, double) { return light.position; }

}  // namespace

LightModel spot_light();
LightModel spot_light() { return {{}, {}, {}, irradiance, specular, target, false, false}; }

}  // namespace chiaro::twin
