// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "controller/twin/mesh/raw_mesh.h"

// The thesis read PLY and 3DS [I-4]; here by suffix, the rest through Assimp.
namespace chiaro::twin {
namespace {

core::Problem refusal(const std::filesystem::path& file, std::string what, std::string remedy) {
  return {{file.string(), 0, 0}, std::move(what), std::move(remedy)};
}

/// What no reader may be trusted with: indices, numbers and sizes.
core::Result<RawMesh> checked(const std::filesystem::path& file, RawMesh mesh) {
  if (mesh.indices.empty())
    return refusal(
        file,
        "the mesh has no triangles (" + std::to_string(mesh.vertices()) + " points, no faces)",
        "export surfaces, not a point cloud or curves");
  if (mesh.triangles() > kMostTriangles)
    return refusal(file, "the mesh has more than 40 million triangles",
                   "decimate it: 100,000 triangles light as well");
  const std::size_t vertices = mesh.vertices();
  for (const std::uint32_t i : mesh.indices)
    if (i >= vertices)
      return refusal(
          file, "a face speaks of point " + std::to_string(i) + " of " + std::to_string(vertices),
          "the file is damaged: export it again");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!(std::abs(mesh.positions[i]) <= 1e9f))
      return refusal(file,
                     "point " + std::to_string(i / 3) +
                         (std::isfinite(mesh.positions[i]) ? " is further away than 1e9 units"
                                                           : " is not a number"),
                     "the file is damaged: export it again");
  const auto bad = [](float v) { return !std::isfinite(v); };
  // Bad normals and texture coordinates can be made anew or done without.
  if (std::any_of(mesh.normals.begin(), mesh.normals.end(), bad)) mesh.normals.clear();
  if (std::any_of(mesh.texture_coordinates.begin(), mesh.texture_coordinates.end(), bad))
    mesh.texture_coordinates.clear();
  return mesh;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

core::Result<RawMesh> read_mesh(const std::filesystem::path& file,
                                const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return refusal(file, "the mesh file is empty (0 bytes)", "export it again");
  const std::string kind = lower_extension(file);
  const std::string known[] = {".ply", ".obj", ".3ds", ".stl", ".gltf", ".glb", ".off", ".dae"};
  if (std::find(std::begin(known), std::end(known), kind) == std::end(known))
    return refusal(file, "meshes of the kind \"" + kind + "\" are not read",
                   "export it as .ply, .obj, .3ds, .stl, .gltf or .glb");
  auto raw = kind == ".ply" ? read_ply(file, bytes) : read_with_assimp(file);
  if (!raw) return raw.problems();
  raw->y_up = kind == ".obj" || kind == ".gltf" || kind == ".glb" || kind == ".dae";
  return checked(file, std::move(*raw));
}

}  // namespace chiaro::twin
