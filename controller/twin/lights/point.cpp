// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

double irradiance(const Light& light, core::Vec3 at, core::Vec3 normal) {
  const core::Vec3 to = light.position - at;
  return light.candela * faded(light.attenuation, length(to)) *
         std::max(0.0, dot(normal, unit(to)));
}

double specular(const Light& light, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                double shininess) {
  const core::Vec3 to = light.position - at;
  return light.candela * faded(light.attenuation, length(to)) *
         highlight(normal, unit(to), viewer, shininess);
}

core::Vec3 target(const Light& light, core::Vec3, double, double) { return light.position; }

}  // namespace

LightModel point_light();
LightModel point_light() { return {{}, {}, {}, irradiance, specular, target, false, false}; }

}  // namespace chiaro::twin
