// SPDX-License-Identifier: Apache-2.0
// What a ray met: position, normals and material at a hit. Shared by the view and the simulator's
// path tracer, so that both see the same surface.
#pragma once

#include "controller/core/colour.h"
#include "controller/core/geometry.h"
#include "controller/render/view.h"

namespace chiaro::render {

struct Surface {
  core::Vec3 position, normal, face;  ///< unit, both turned towards where the ray came from
  core::Rgb diffuse;                  ///< albedo, texture applied
  double specular = 0, shininess = 16;
};
/// Precondition: hit.hit. `direction` is the ray's, unit.
Surface surface_at(const twin::Geometry& geometry, const Tracer::Hit& hit, core::Vec3 direction);

}  // namespace chiaro::render
