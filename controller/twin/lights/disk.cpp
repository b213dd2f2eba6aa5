// SPDX-License-Identifier: Apache-2.0
// The light vector of a disk of even luminance in closed form (from the configuration factors of a
// disk to parallel and to perpendicular elements, Howell B-13 and B-14 family). Where the surface's
// horizon cuts the disk, the cut is taken from a spherical cap with the same light vector.
#include <algorithm>
#include <cmath>

#include "controller/twin/lights/light_model.h"

namespace chiaro::twin {
namespace {

using core::Vec3;

/// Configuration-factor vector: its dot product with a normal that sees the whole disk is the
/// fraction of a full sky. Zero behind the face.
Vec3 factor(const Light& light, Vec3 at) {
  const Vec3 from = at - light.position;
  const double h = dot(from, light.direction);
  if (h <= 0) return {};
  const Vec3 aside = from - h * light.direction;
  const double rr = dot(aside, aside), hh = h * h, RR = light.radius * light.radius;
  const double q = hh + rr + RR;
  const double s = std::sqrt(std::max(q * q - 4 * RR * rr, 1e-300));
  // Both forms are equal; each is used where it does not cancel.
  const double off = hh + rr - RR;
  const double axial = off > 0 ? 2 * RR * hh / (s * (s + off)) : 0.5 * (1 - off / s);
  const double radial_per_metre = 2 * h * RR / (s * (q + s));
  return -axial * light.direction - radial_per_metre * aside;
}

/// Configuration factor of a spherical cap with half angle asin(sqrt(f)) whose middle stands at
/// `cosine` from the normal, cut at the horizon (Snyder 1996).
double capped(double f, double cosine) {
  if (cosine * cosine >= f) return f * std::max(cosine, 0.0);
  const double sine = std::sqrt(std::max(1 - cosine * cosine, 1e-12));
  const double x = std::sqrt(std::max(1 / f - 1, 0.0));
  const double y = std::clamp(-x * cosine / sine, -1.0, 1.0);
  const double z = sine * std::sqrt(1 - y * y);
  return std::max(0.0, ((cosine * std::acos(y) - x * z) * f + std::atan2(z, x)) / core::kPi);
}

double irradiance(const Light& light, Vec3 at, Vec3 normal) {
  const Vec3 vector = factor(light, at);
  const double f = std::min(length(vector), 1.0);
  if (f <= 0) return 0;
  const double luminance =
      light.candela / (core::kPi * std::max(light.radius * light.radius, 1e-9));
  const double d = distance(at, light.position);
  return core::kPi * luminance * capped(f, std::clamp(dot(vector, normal) / f, -1.0, 1.0)) *
         std::max(d * d, 1e-12) * faded(light.attenuation, d);
}

double specular(const Light& light, Vec3 at, Vec3 normal, Vec3 viewer, double shininess) {
  return face_specular(light, disk_points(shininess), light.radius, light.radius, at, normal,
                       viewer, shininess);
}

/// Concentric map (Shirley and Chiu 1997): strata stay compact.
Vec3 target(const Light& light, Vec3, double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return light.position;
  const bool wide = std::abs(a) > std::abs(b);
  const double r = light.radius * (wide ? a : b);
  const double turn = wide ? core::kPi / 4 * (b / a) : core::kPi / 2 - core::kPi / 4 * (a / b);
  return light.position + r * std::cos(turn) * light.right + r * std::sin(turn) * light.up;
}

}  // namespace

LightModel disk_light();
LightModel disk_light() { return {{}, {}, {}, irradiance, specular, target, true, false}; }

}  // namespace chiaro::twin
