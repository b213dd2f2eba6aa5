// SPDX-License-Identifier: Apache-2.0
// Small bodies for the studies' scenes, made of numbers: model space, metres, Z up, standing on
// z = 0, outward normals.
#pragma once

#include "simulator/bust/surface_net.h"

namespace chiaro::daemon::study {

simulator::TriangleMesh ball(double radius);
simulator::TriangleMesh box(core::Vec3 size);
/// A ring lying flat.
simulator::TriangleMesh ring(double radius, double thickness);
simulator::TriangleMesh vase(double height);
/// A tube along a trefoil knot, upright.
simulator::TriangleMesh knot(double radius, double thickness);

}  // namespace chiaro::daemon::study
