// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

double irradiance(const Light& light, core::Vec3, core::Vec3 normal) {
  return light.candela * std::max(0.0, -dot(normal, light.direction));
}

double specular(const Light& light, core::Vec3, core::Vec3 normal, core::Vec3 viewer,
                double shininess) {
  return light.candela * highlight(normal, -light.direction, viewer, shininess);
}

core::Vec3 target(const Light& light, core::Vec3 at, double, double) {
  return at - kFarAway * light.direction;
}

}  // namespace

LightModel directional_light();
LightModel directional_light() { return {{}, {}, {}, irradiance, specular, target, false, true}; }

}  // namespace chiaro::twin
