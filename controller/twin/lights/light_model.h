// SPDX-License-Identifier: Apache-2.0
// What a kind of light does to a surface, in closed form and without shadows. Reference formulas in
// double precision; the vector kernels of `render` are tested against them.
#pragma once

#include <span>
#include <string_view>

#include "controller/core/geometry.h"
#include "controller/twin/scene.h"

namespace chiaro::twin {

/// All functions are pure and finite for finite input (also at and behind the lamp). `at` is a
/// point of the surface in metres, `normal` its unit normal, `viewer` the unit direction to the
/// camera.
struct LightModel {
  studio::Optic::Kind kind;
  std::string_view name, summary;
  /// Unshadowed irradiance in lux at full level, luminance of the white light; 0 where the surface
  /// faces away or lies behind the lamp's face.
  double (*irradiance)(const Light& light, core::Vec3 at, core::Vec3 normal);
  /// Blinn-Phong: sum over the face of E_perp (N.H)^shininess where N.L > 0, in lux.
  double (*specular)(const Light& light, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                     double shininess);
  /// Where a shadow ray from `at` goes for (u, v) in the unit square: uniform over the face; small
  /// sources have one target for all.
  core::Vec3 (*target)(const Light& light, core::Vec3 at, double u, double v);
  bool has_area = false;  ///< many targets, soft shadows
  bool parallel = false;  ///< the target moves with `at`; otherwise it does not depend on it
};

std::span<const LightModel> light_models();
const LightModel& light_model(studio::Optic::Kind kind);

/// Factor by which light has faded after `distance` metres, 1 at one metre.
double faded(studio::Optic::Attenuation attenuation, double distance);
/// (N.H)^shininess for a unit direction to the light, 0 when it is behind the surface.
double highlight(core::Vec3 normal, core::Vec3 to_light, core::Vec3 viewer, double shininess);

/// The highlight of a flat face is a weighted sum over a few of its points (Gauss-Legendre on
/// rectangles, Abramowitz and Stegun 25.4.61 on disks): smooth, cheap, and exact to a per cent or
/// so, because the lobe is wider than the gaps. Sharper surfaces take more points. Offsets are
/// fractions of the half extent, weights sum to 1.
struct FacePoint {
  double x, y, weight;
};
inline constexpr double kFewPointsUpTo = 40;  ///< shininess
std::span<const FacePoint> face_points(double shininess);
std::span<const FacePoint> disk_points(double shininess);
double face_specular(const Light& light, std::span<const FacePoint> points, double half_right,
                     double half_up, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                     double shininess);

}  // namespace chiaro::twin
