// SPDX-License-Identifier: Apache-2.0
// One random point of a lamp as a surface point receives it (next-event estimation).
#pragma once

#include "controller/twin/scene.h"

namespace chiaro::simulator {

struct LightSample {
  core::Vec3 from;     ///< where the light leaves the lamp (a far point for a sun)
  core::Vec3 towards;  ///< unit, from the surface to the lamp
  double lux = 0;      ///< on a plane facing the lamp, at full level; 0 = none arrives
};
/// `u`, `v` in [0, 1): which point of a rectangle or a disk. The mean of `lux` over them is the
/// illuminance of the whole face.
LightSample sample(const twin::Light& light, core::Vec3 at, double u, double v);

}  // namespace chiaro::simulator
