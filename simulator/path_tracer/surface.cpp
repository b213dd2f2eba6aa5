// SPDX-License-Identifier: Apache-2.0
#include "simulator/path_tracer/surface.h"

#include <algorithm>
#include <cmath>

namespace chiaro::simulator {
namespace {

using core::Rgb;
using core::Vec3;

/// Metres: above the rounding of a 10 m studio, below what a camera could see.
constexpr double kLift = 2e-4;

Vec3 vertex(const std::vector<float>& values, std::uint32_t index) {
  const std::size_t i = 3 * std::size_t{index};
  return {values[i], values[i + 1], values[i + 2]};
}

struct Corners {
  std::uint32_t a, b, c;
};
Corners corners(const twin::Mesh& mesh, std::uint32_t triangle) {
  const std::uint32_t* i = mesh.indices.data() + 3 * std::size_t{triangle};
  return {i[0], i[1], i[2]};
}

Rgb texel(const core::Picture& texture, double u, double v) {
  const core::Size size = texture.size();
  const auto wrapped = [](double t, int n) {
    const int i = static_cast<int>((t - std::floor(t)) * n);
    return std::min(i, n - 1);
  };
  return texture.at(wrapped(u, size.width), wrapped(1 - v, size.height));
}

Rgb albedo_at(const twin::Geometry& geometry, const twin::Mesh& mesh,
              const twin::SurfaceMaterial& material, const render::Tracer::Hit& hit) {
  if (material.texture < 0 || mesh.texture_coordinates.empty()) return material.diffuse;
  const Corners at = corners(mesh, hit.triangle);
  const double w = 1.0 - hit.u - hit.v;
  const auto blend = [&](std::size_t k) {
    const auto& t = mesh.texture_coordinates;
    return w * t[2 * std::size_t{at.a} + k] + hit.u * t[2 * std::size_t{at.b} + k] +
           hit.v * t[2 * std::size_t{at.c} + k];
  };
  const auto& texture = geometry.textures[static_cast<std::size_t>(material.texture)];
  return material.diffuse * texel(texture, blend(0), blend(1));
}

}  // namespace

std::optional<Surface> surface_along(const render::Tracer& tracer, Vec3 from, Vec3 direction) {
  const render::Tracer::Hit hit = tracer.closest(from, direction);
  if (!hit.hit) return std::nullopt;
  const twin::Geometry& geometry = tracer.geometry();
  const twin::Mesh& mesh = geometry.meshes[hit.mesh];
  const Corners at = corners(mesh, hit.triangle);
  const Vec3 a = vertex(mesh.positions, at.a);
  const Vec3 face =
      core::unit(core::cross(vertex(mesh.positions, at.b) - a, vertex(mesh.positions, at.c) - a));
  const double w = 1.0 - hit.u - hit.v;
  const Vec3 smooth =
      core::unit(w * vertex(mesh.normals, at.a) + double{hit.u} * vertex(mesh.normals, at.b) +
                 double{hit.v} * vertex(mesh.normals, at.c));
  const twin::SurfaceMaterial& material = geometry.materials[mesh.material[hit.triangle]];
  Surface surface;
  surface.position = from + double{hit.distance} * direction;
  surface.viewer = -direction;
  surface.face = core::dot(face, direction) > 0 ? -face : face;
  surface.normal = core::dot(smooth, direction) > 0 ? -smooth : smooth;
  surface.albedo = albedo_at(geometry, mesh, material, hit);
  surface.specular = material.specular;
  surface.shininess = material.shininess;
  return surface;
}

Vec3 lifted(const Surface& surface) { return surface.position + kLift * surface.face; }

}  // namespace chiaro::simulator
