// SPDX-License-Identifier: Apache-2.0
#include "controller/render/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro::render {
namespace {

using core::Vec3;

core::Rgb texel(const core::Picture& picture, int x, int y) {
  const core::Size size = picture.size();
  const auto wrapped = [](int v, int n) { return (v % n + n) % n; };
  return picture.at(wrapped(x, size.width), wrapped(y, size.height));
}

/// Bilinear, repeating; v runs upwards while rows run downwards.
core::Rgb sampled(const core::Picture& picture, double u, double v) {
  if (!std::isfinite(u) || !std::isfinite(v)) return {0.5, 0.5, 0.5};
  const double x = (u - std::floor(u)) * picture.size().width - 0.5;
  const double y = (1 - (v - std::floor(v))) * picture.size().height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  return (1 - fx) * (1 - fy) * texel(picture, x0, y0) + fx * (1 - fy) * texel(picture, x0 + 1, y0) +
         (1 - fx) * fy * texel(picture, x0, y0 + 1) + fx * fy * texel(picture, x0 + 1, y0 + 1);
}

Vec3 at(const std::vector<float>& list, std::size_t i) {
  return {list[3 * i], list[3 * i + 1], list[3 * i + 2]};
}

}  // namespace

Surface surface_at(const twin::Geometry& geometry, const Tracer::Hit& hit, Vec3 direction) {
  const twin::Mesh& mesh = geometry.meshes[hit.mesh];
  const std::array<std::size_t, 3> c{mesh.indices[3 * hit.triangle],
                                     mesh.indices[3 * hit.triangle + 1],
                                     mesh.indices[3 * hit.triangle + 2]};
  const double u = hit.u, v = hit.v, w = 1 - u - v;
  const Vec3 a = at(mesh.positions, c[0]), b = at(mesh.positions, c[1]),
             d = at(mesh.positions, c[2]);
  Surface out;
  // From the corners, not along the ray: an order of magnitude more exact at studio distances.
  out.position = w * a + u * b + v * d;
  out.face = unit(cross(b - a, d - a));
  if (dot(out.face, direction) > 0) out.face = -out.face;
  out.normal =
      unit(w * at(mesh.normals, c[0]) + u * at(mesh.normals, c[1]) + v * at(mesh.normals, c[2]));
  if (dot(out.normal, out.face) < 0) out.normal = -out.normal;
  // Near a silhouette the smooth normal can point away from the viewer: bend it to grazing.
  const double away = dot(out.normal, direction);
  if (away > -1e-3) out.normal = unit(out.normal - (away + 1e-3) * direction);
  const twin::SurfaceMaterial& material = geometry.materials[mesh.material[hit.triangle]];
  out.diffuse = material.diffuse;
  out.specular = material.specular;
  out.shininess = material.shininess;
  if (material.texture >= 0 && !mesh.texture_coordinates.empty()) {
    const float* t = mesh.texture_coordinates.data();
    out.diffuse =
        out.diffuse * sampled(geometry.textures[static_cast<std::size_t>(material.texture)],
                              w * t[2 * c[0]] + u * t[2 * c[1]] + v * t[2 * c[2]],
                              w * t[2 * c[0] + 1] + u * t[2 * c[1] + 1] + v * t[2 * c[2] + 1]);
  }
  return out;
}

}  // namespace chiaro::render
