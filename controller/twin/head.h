// SPDX-License-Identifier: Apache-2.0
// Finding the head of a subject: lamps are placed and aimed about it.
#pragma once

#include "controller/core/geometry.h"
#include "controller/twin/scene.h"

namespace chiaro::twin {

/// The middle of the head, or of the whole mesh's box where no neck is found. `across` is unit and
/// level: the subject's own left-right axis, along which shoulders are wide. Precondition: the mesh
/// has triangles.
core::Vec3 head_centre(const Mesh& mesh, core::Vec3 across);

core::Box3 bounds_of(const Mesh& mesh);

}  // namespace chiaro::twin
