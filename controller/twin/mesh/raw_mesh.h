// SPDX-License-Identifier: Apache-2.0
// A mesh as its file has it: model space, the file's units and axes, nothing mended yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/twin/scene.h"

namespace chiaro::twin {

struct RawMesh {
  std::vector<float> positions;            ///< x y z per vertex
  std::vector<float> normals;              ///< x y z per vertex, or empty
  std::vector<float> texture_coordinates;  ///< u v per vertex, or empty; v runs upwards
  std::vector<std::uint32_t> indices;      ///< three per triangle
  std::vector<std::uint16_t> material;     ///< one per triangle
  std::vector<SurfaceMaterial> materials;  ///< at least one
  std::vector<core::EncodedPicture> textures;
  bool y_up = false;                           ///< by the format's custom; else Z up
  std::vector<std::filesystem::path> depends;  ///< other files that were read (MTL, textures)
  std::vector<std::string> warnings;           ///< what was left out, for people
  std::size_t vertices() const { return positions.size() / 3; }
  std::size_t triangles() const { return indices.size() / 3; }
};

/// No file beyond these is imported: a subject needs 1 M triangles at the very most.
inline constexpr std::size_t kMostTriangles = 40'000'000;
inline constexpr std::size_t kMostMeshBytes = std::size_t{2} << 30;

/// Reads `.ply` by ourselves (ASCII, both binary orders; fast), everything else through Assimp.
/// Custom of the formats: OBJ, glTF and DAE are Y up with +Z in front; PLY, STL, 3DS and OFF are
/// Z up with -Y in front. `bytes` is the file's content. Never throws on bad input.
core::Result<RawMesh> read_mesh(const std::filesystem::path& file,
                                const std::vector<std::uint8_t>& bytes);
core::Result<RawMesh> read_ply(const std::filesystem::path& file,
                               const std::vector<std::uint8_t>& bytes);
core::Result<RawMesh> read_with_assimp(const std::filesystem::path& file);

}  // namespace chiaro::twin
