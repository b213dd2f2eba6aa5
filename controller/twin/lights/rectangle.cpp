// SPDX-License-Identifier: Apache-2.0
// Lambert's formula for a polygon of even luminance (Photometria, 1760; Baum, Rushmeier and Winget
// 1989): E = L/2 times the sum over edges of angle subtended x cosine between the edge's plane
// normal and the surface's, after cutting the polygon at the surface's horizon.
#include <algorithm>
#include <array>
#include <cmath>

#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

using core::Vec3;

/// The part of a convex polygon with dot(normal, v) >= 0. At most one corner more than it had.
std::size_t above_horizon(std::span<const Vec3> polygon, Vec3 normal, std::span<Vec3> out) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double za = dot(normal, a), zb = dot(normal, b);
    if (za >= 0) out[n++] = a;
    if ((za >= 0) != (zb >= 0)) out[n++] = a + (za / (za - zb)) * (b - a);
  }
  return n;
}

/// Angle subtended by an edge, times its plane's unit normal on the surface's normal.
double edge(Vec3 a, Vec3 b, Vec3 normal) {
  const Vec3 across = cross(a, b);
  const double sine = length(across);
  return sine > 0 ? std::atan2(sine, dot(a, b)) * dot(across, normal) / sine : 0;
}

double irradiance(const Light& light, Vec3 at, Vec3 normal) {
  const Vec3 to = light.position - at;
  if (dot(to, light.direction) >= 0) return 0;  // behind the face
  const Vec3 r = 0.5 * light.width * light.right, u = 0.5 * light.height * light.up;
  const std::array<Vec3, 4> corners{to - r - u, to + r - u, to + r + u, to - r + u};
  std::array<Vec3, 8> seen;
  const std::size_t n = above_horizon(corners, normal, seen);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += edge(seen[i], seen[(i + 1) % n], normal);
  const double luminance = light.candela / std::max(light.width * light.height, 1e-9);
  const double d = length(to);
  // The formula holds inverse square; other laws scale it as they would a point in its middle.
  return 0.5 * luminance * std::abs(sum) * std::max(d * d, 1e-12) * faded(light.attenuation, d);
}

double specular(const Light& light, Vec3 at, Vec3 normal, Vec3 viewer, double shininess) {
  return face_specular(light, face_points(shininess), 0.5 * light.width, 0.5 * light.height, at,
                       normal, viewer, shininess);
}

Vec3 target(const Light& light, Vec3, double u, double v) {
  return light.position + (u - 0.5) * light.width * light.right +
         (v - 0.5) * light.height * light.up;
}

}  // namespace

LightModel rectangle_light();
LightModel rectangle_light() { return {{}, {}, {}, irradiance, specular, target, true, false}; }

}  // namespace chiaro::twin
