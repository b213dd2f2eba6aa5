// SPDX-License-Identifier: Apache-2.0
// A mesh made ready for lighting, still in model space, and its copy on disk: importing a million
// triangles takes a second or more, reading them prepared takes tens of milliseconds.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "controller/twin/mesh/raw_mesh.h"

namespace chiaro::twin {

/// Corners whose faces meet at a sharper angle than this are not smoothed over.
inline constexpr double kCreaseDegrees = 60;

struct PreparedMesh {
  std::vector<float> positions, normals, texture_coordinates;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> material;
  std::vector<SurfaceMaterial> materials;
  std::vector<core::EncodedPicture> textures;
  bool y_up = false;
  std::vector<std::string> warnings;
};

/// Welds equal vertices, drops triangles without area and duplicates of triangles (also those that
/// are a surface's other side), makes smooth normals (crease-aware, angle-weighted) where the file
/// has none. May come out empty.
PreparedMesh prepared(RawMesh raw);

/// Reads, prepares and remembers. The cache's key is the content of the mesh file; an entry also
/// names the content of every other file it was made from, and a checksum of itself. An entry that
/// is missing, stale or damaged is made anew without a word; a cache that cannot be written is
/// only slower. Safe with several processes: entries appear by rename.
core::Result<PreparedMesh> load_mesh(const std::filesystem::path& file,
                                     const std::filesystem::path& cache);

/// Where load_mesh keeps the mesh with this content. For tests and `chiaro bench`.
std::filesystem::path cache_entry(const std::filesystem::path& cache, std::uint64_t content);
/// 64 bits of a file's or entry's bytes, four lanes at a time: FNV-1a takes a second for a
/// gigabyte.
std::uint64_t content_hash(const std::uint8_t* bytes, std::size_t size);

std::vector<std::uint8_t> serialised(const PreparedMesh& mesh,
                                     const std::vector<std::filesystem::path>& depends);
/// Nothing when the bytes are not an entry of this version, undamaged and fresh.
std::optional<PreparedMesh> deserialised(const std::vector<std::uint8_t>& bytes);

}  // namespace chiaro::twin
