// SPDX-License-Identifier: Apache-2.0
// The bust as triangles, and as the file that ships.
#pragma once

#include <filesystem>

#include "controller/core/result.h"
#include "simulator/bust/surface_net.h"

namespace chiaro::simulator {

/// `detail` 1 is what ships (60 to 100 thousand triangles); smaller is coarser, for tests.
TriangleMesh bust_mesh(double detail = 1);

/// Binary little-endian PLY with normals.
core::Result<core::Done> write_ply(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace chiaro::simulator
