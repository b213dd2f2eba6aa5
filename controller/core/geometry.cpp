// SPDX-License-Identifier: Apache-2.0
#include "controller/core/geometry.h"

#include <algorithm>

namespace chiaro::core {

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double angle_between(Vec3 a, Vec3 b) {
  // atan2 keeps its precision near 0 and pi, where acos loses half its digits.
  return std::atan2(length(cross(a, b)), dot(a, b));
}

AimFrame aim_frame(Vec3 aim, Vec3 camera) {
  Vec3 towards{camera.x - aim.x, camera.y - aim.y, 0};
  towards = length(towards) < 1e-9 ? Vec3{0, -1, 0} : unit(towards);
  return {aim, towards, cross(Vec3{0, 0, 1}, towards)};
}

Vec3 position(const AimFrame& frame, const Spherical& place) {
  const double flat = place.distance * std::cos(place.elevation);
  return frame.origin + flat * std::cos(place.azimuth) * frame.towards_camera +
         flat * std::sin(place.azimuth) * frame.camera_right +
         Vec3{0, 0, place.distance * std::sin(place.elevation)};
}

Spherical spherical(const AimFrame& frame, Vec3 position) {
  const Vec3 from_aim = position - frame.origin;
  const double towards = dot(from_aim, frame.towards_camera);
  const double right = dot(from_aim, frame.camera_right);
  return {std::atan2(right, towards), std::atan2(from_aim.z, std::hypot(towards, right)),
          length(from_aim)};
}

void Box3::include(Vec3 p) {
  least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
  most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
}

}  // namespace chiaro::core
