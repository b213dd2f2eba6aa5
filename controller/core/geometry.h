// SPDX-License-Identifier: Apache-2.0
// Points and directions in the studio: metres, right-handed, Z up, the main camera looks roughly
// along +Y at the subject's mark near the origin.
#pragma once

#include <cmath>

namespace chiaro::core {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend constexpr bool operator==(Vec3, Vec3) = default;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 v) { return {k * v.x, k * v.y, k * v.z}; }
  friend constexpr Vec3 operator*(Vec3 v, double k) { return k * v; }
  friend constexpr Vec3 operator/(Vec3 v, double k) { return (1.0 / k) * v; }
};
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 v) { return std::sqrt(dot(v, v)); }
/// Precondition: length(v) > 0; a zero vector comes back unchanged.
inline Vec3 unit(Vec3 v) {
  const double l = length(v);
  return l > 0 ? v / l : v;
}
inline double distance(Vec3 a, Vec3 b) { return length(a - b); }
bool finite(Vec3 v);
/// Angle between two directions, radians in [0, pi].
double angle_between(Vec3 a, Vec3 b);

/// A lamp's place as seen from the subject: radians and metres. Azimuth 0 is towards the main
/// camera, positive to the *camera's right*; elevation is positive upwards.
struct Spherical {
  double azimuth = 0, elevation = 0, distance = 1;
  friend bool operator==(const Spherical&, const Spherical&) = default;
};

/// The frame in which azimuth, elevation and distance are measured: the subject's aim point and
/// the horizontal direction from it towards the main camera.
struct AimFrame {
  Vec3 origin;
  Vec3 towards_camera{0, -1, 0};  ///< unit, horizontal
  Vec3 camera_right{1, 0, 0};     ///< unit, horizontal, = cross(up, towards_camera)
};
/// Precondition: the camera is not exactly above the aim (then -Y is taken as "towards").
AimFrame aim_frame(Vec3 aim, Vec3 camera);
Vec3 position(const AimFrame& frame, const Spherical& place);
Spherical spherical(const AimFrame& frame, Vec3 position);

struct Box3 {
  Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
  void include(Vec3 p);
  bool empty() const { return most.x < least.x; }
  Vec3 centre() const { return 0.5 * (least + most); }
  Vec3 extent() const { return most - least; }
};

}  // namespace chiaro::core
