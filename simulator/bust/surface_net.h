// SPDX-License-Identifier: Apache-2.0
// From a signed distance to triangles: naive surface nets (Gibson 1998) on a rectilinear grid,
// which may be finer where detail is, with the vertices then pulled onto the surface.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "controller/core/geometry.h"

namespace chiaro::simulator {

struct TriangleMesh {
  std::vector<core::Vec3> positions, normals;           ///< normals unit, outward
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< anticlockwise from outside
};

using Distance = std::function<double(core::Vec3)>;

/// Grid planes along each axis, ascending.
struct GridLines {
  std::vector<double> x, y, z;
};

/// Closed as long as the surface stays inside the grid and no cell holds two sheets of it.
/// `distance` is called from many threads; the result does not depend on how many.
TriangleMesh surface_net(const Distance& distance, const GridLines& grid);

}  // namespace chiaro::simulator
