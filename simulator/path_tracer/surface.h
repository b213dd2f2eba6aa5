// SPDX-License-Identifier: Apache-2.0
// What a path meets: the point, its normals towards the side it came from, and its material.
#pragma once

#include <optional>

#include "controller/render/view.h"

namespace chiaro::simulator {

struct Surface {
  core::Vec3 position, normal, face;  ///< shading and geometric normal, unit, towards the viewer
  core::Vec3 viewer;                  ///< unit, back along the ray
  core::Rgb albedo;
  double specular = 0, shininess = 16;
};

/// The nearest surface along the ray, nothing when it leaves the studio. `direction` is unit.
std::optional<Surface> surface_along(const render::Tracer& tracer, core::Vec3 from,
                                     core::Vec3 direction);
/// A point just off the surface, on the viewer's side: where shadow and bounce rays start.
core::Vec3 lifted(const Surface& surface);

}  // namespace chiaro::simulator
