// SPDX-License-Identifier: Apache-2.0
// Small worlds made of numbers, for tests of twin, render and design: spheres, cards, studios about
// them. No files unless asked for.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "controller/studio/studio.h"
#include "controller/twin/scene.h"

namespace chiaro::support {

/// A sphere of `20 * 4^levels` triangles with its true normals.
twin::Mesh icosphere(core::Vec3 centre, double radius, int levels);
/// A rectangle about `centre` spanned by two half vectors; its normal is along right x up.
twin::Mesh card(core::Vec3 centre, core::Vec3 half_right, core::Vec3 half_up);

/// Meshes with one grey material; the first is the subject, the aim the middle of its box, the
/// camera's side -Y. Bounds are set.
std::shared_ptr<const twin::Geometry> geometry_of(std::vector<twin::Mesh> meshes,
                                                  twin::SurfaceMaterial material = {});

/// Writes `mesh` (model space, points and triangles only) as binary PLY.
void write_ply(const std::filesystem::path& file, const twin::Mesh& mesh);

/// A fixture of that optic on a stand, 2000 cd, aimed at the subject.
studio::Fixture stand_fixture(const std::string& name, studio::Optic optic, core::Spherical at,
                              studio::Region region = {});
/// A sphere of 0.2 m at height 1.4 m before a wall, a camera 2.6 m in front, key, fill and back.
/// The subject's mesh is written into `folder`.
studio::Studio ball_studio(const std::filesystem::path& folder, int levels = 4);

/// A fresh folder under the system's temporary one, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace chiaro::support
