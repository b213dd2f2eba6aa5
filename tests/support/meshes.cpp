// SPDX-License-Identifier: Apache-2.0
#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <unistd.h>

namespace chiaro::support {
namespace {

using core::Vec3;

void append(std::vector<float>& list, Vec3 v) {
  list.insert(list.end(),
              {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

/// Unit points and triangles of a subdivided icosahedron.
struct Ball {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Ball icosahedron() {
  const double t = (1 + std::sqrt(5.0)) / 2;
  Ball ball;
  for (const Vec3 p : {Vec3{-1, t, 0}, Vec3{1, t, 0}, Vec3{-1, -t, 0}, Vec3{1, -t, 0},
                       Vec3{0, -1, t}, Vec3{0, 1, t}, Vec3{0, -1, -t}, Vec3{0, 1, -t},
                       Vec3{t, 0, -1}, Vec3{t, 0, 1}, Vec3{-t, 0, -1}, Vec3{-t, 0, 1}})
    ball.points.push_back(unit(p));
  ball.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return ball;
}

Ball finer(const Ball& from) {
  Ball out{from.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, fresh] = middles.try_emplace(std::pair(std::min(a, b), std::max(a, b)), 0);
    if (fresh) {
      entry->second = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(unit(out.points[a] + out.points[b]));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : from.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.triangles.insert(out.triangles.end(),
                         {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return out;
}

}  // namespace

twin::Mesh icosphere(Vec3 centre, double radius, int levels) {
  Ball ball = icosahedron();
  for (int i = 0; i < levels; ++i) ball = finer(ball);
  twin::Mesh mesh;
  mesh.name = "ball";
  for (const Vec3 p : ball.points) {
    append(mesh.positions, centre + radius * p);
    append(mesh.normals, p);
  }
  for (const auto& t : ball.triangles) mesh.indices.insert(mesh.indices.end(), t.begin(), t.end());
  mesh.material.assign(mesh.triangles(), 0);
  mesh.positions.push_back(0);
  return mesh;
}

twin::Mesh card(Vec3 centre, Vec3 half_right, Vec3 half_up) {
  twin::Mesh mesh;
  mesh.name = "card";
  const Vec3 normal = unit(cross(half_right, half_up));
  for (const Vec3 p : {centre - half_right - half_up, centre + half_right - half_up,
                       centre + half_right + half_up, centre - half_right + half_up}) {
    append(mesh.positions, p);
    append(mesh.normals, normal);
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.material = {0, 0};
  mesh.positions.push_back(0);
  return mesh;
}

std::shared_ptr<const twin::Geometry> geometry_of(std::vector<twin::Mesh> meshes,
                                                  twin::SurfaceMaterial material) {
  auto out = std::make_shared<twin::Geometry>();
  out->materials = {material};
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    meshes[m].subject = m == 0;
    for (std::size_t i = 0; i + 2 < meshes[m].positions.size(); i += 3) {
      const Vec3 p{meshes[m].positions[i], meshes[m].positions[i + 1], meshes[m].positions[i + 2]};
      out->bounds.include(p);
      if (m == 0) out->subject_bounds.include(p);
    }
  }
  out->meshes = std::move(meshes);
  const Vec3 aim = out->subject_bounds.centre();
  out->aim = core::aim_frame(aim, aim + Vec3{0, -1, 0});
  out->radius = 0.5 * length(out->subject_bounds.extent());
  return out;
}

void write_ply(const std::filesystem::path& file, const twin::Mesh& mesh) {
  std::ofstream out(file, std::ios::binary);
  const std::size_t vertices = mesh.positions.size() / 3;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  out.write(reinterpret_cast<const char*>(mesh.positions.data()),
            static_cast<std::streamsize>(3 * vertices * sizeof(float)));
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    out.put(3);
    out.write(reinterpret_cast<const char*>(&mesh.indices[3 * t]), 3 * sizeof(std::uint32_t));
  }
}

studio::Fixture stand_fixture(const std::string& name, studio::Optic optic, core::Spherical at,
                              studio::Region region) {
  studio::Fixture fixture;
  fixture.name = name;
  fixture.profile.name = "generic/dimmer";
  fixture.profile.optic = optic;
  fixture.output = {2000};
  fixture.mount = studio::StandMount{at, region};
  fixture.patch = studio::NoPatch{};
  fixture.initial.set(core::Dof::intensity, 1);
  return fixture;
}

studio::Studio ball_studio(const std::filesystem::path& folder, int levels) {
  studio::Studio out;
  out.name = "ball";
  studio::Subject subject;
  subject.name = "ball";
  subject.mesh = folder / "ball.ply";
  write_ply(subject.mesh, icosphere({}, 0.2, levels));
  subject.at = {0, 0, 1.2};
  subject.material = studio::Material{{0.6, 0.5, 0.4}, 0.1, 24};
  out.subjects.push_back(subject);
  out.background.push_back(
      {"wall", {0, 1.2, 0}, {0, -1, 0}, 6, 4, {{0.35, 0.35, 0.35}, 0, 16}, {}});
  studio::Camera camera;
  camera.name = "main";
  camera.at = {0, -2.6, 1.45};
  camera.look_at = {0, 0, 1.4};
  camera.vertical_fov = core::radians(16);
  camera.size = {256, 256};
  out.cameras.push_back(camera);
  const auto degrees = [](double azimuth, double elevation, double distance) {
    return core::Spherical{core::radians(azimuth), core::radians(elevation), distance};
  };
  const studio::Region front{
      {core::radians(-80), core::radians(80)}, {core::radians(-10), core::radians(70)}, {1.2, 2.4}};
  studio::Optic soft;
  soft.kind = studio::Optic::Kind::rectangle;
  soft.width = 0.6;
  soft.height = 0.9;
  out.fixtures.push_back(stand_fixture("key", {}, degrees(-45, 35, 1.6), front));
  out.fixtures.push_back(stand_fixture("fill", soft, degrees(40, 10, 1.8), front));
  studio::Fixture back = stand_fixture("back", {}, {});
  back.role = studio::Role::back;
  back.mount = studio::FixedMount{{-0.8, 0.9, 2.3}, {0, 0, 1.4}};
  out.fixtures.push_back(back);
  return out;
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "chiaro-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}
Folder::~Folder() {
  std::error_code code;
  std::filesystem::remove_all(path_, code);
}

}  // namespace chiaro::support
