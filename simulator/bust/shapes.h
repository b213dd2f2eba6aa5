// SPDX-License-Identifier: Apache-2.0
// The clay: signed distances to simple bodies and the smooth ways to join and carve them (after
// Quilez's distance functions). Negative inside. Units are the caller's; the bust works in
// centimetres.
#pragma once

#include <algorithm>
#include <cmath>

#include "controller/core/geometry.h"

namespace chiaro::simulator::clay {

using core::Vec3;

/// Union whose seam is a fillet about `k` wide.
inline double joined(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k * 0.25;
}
inline double common(double a, double b, double k) { return -joined(-a, -b, k); }
/// `body` with `tool` taken away.
inline double carved(double body, double tool, double k) { return common(body, -tool, k); }

inline double sphere(Vec3 p, Vec3 centre, double radius) {
  return core::length(p - centre) - radius;
}

/// Not exact away from the surface, exact enough near it for radii within a factor of about four.
inline double ellipsoid(Vec3 p, Vec3 centre, Vec3 radii) {
  const Vec3 d = p - centre;
  const Vec3 a{d.x / radii.x, d.y / radii.y, d.z / radii.z};
  const Vec3 b{a.x / radii.x, a.y / radii.y, a.z / radii.z};
  const double k0 = core::length(a), k1 = core::length(b);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// A limb whose radius runs from `ra` at `a` to `rb` at `b`.
inline double limb(Vec3 p, Vec3 a, Vec3 b, double ra, double rb) {
  const Vec3 way = b - a;
  const double t = std::clamp(core::dot(p - a, way) / core::dot(way, way), 0.0, 1.0);
  return core::length(p - a - t * way) - (ra + t * (rb - ra));
}

/// Turned about the z axis (x towards y), the y axis (z towards x) or the x axis (y towards z).
inline Vec3 turned_z(Vec3 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}
inline Vec3 turned_y(Vec3 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}
inline Vec3 turned_x(Vec3 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

/// 1 at the centre, 0 far away: a bump to push a surface with.
inline double bump(Vec3 p, Vec3 centre, Vec3 width) {
  const Vec3 d = p - centre;
  const double x = d.x / width.x, y = d.y / width.y, z = d.z / width.z;
  return std::exp(-(x * x + y * y + z * z));
}

inline double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace chiaro::simulator::clay
