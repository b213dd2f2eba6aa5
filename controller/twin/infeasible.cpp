// SPDX-License-Identifier: Apache-2.0
// Where a lamp must not stand. Called for every trial of a search: a few hundred flops, no rays,
// and no text unless something is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "controller/twin/scene.h"

namespace chiaro::twin {
namespace {

using core::Vec3;

constexpr double kLeastFromSitter = 0.6;  // metres
constexpr double kPole = 0.02;            // half a stand's width

/// Higher than this in front of the sitter a lamp hangs on a boom arm, whose pole stands beside the
/// picture: how else would a butterfly light hang straight above the camera's line?
const double kBoomFrom = core::radians(35);

/// What a lamp fills: a sphere, a fitted modifier's face, a stand's pole.
struct Body {
  Vec3 centre;
  double radius = 0;
  bool face = false;
  std::array<Vec3, 9> points;  ///< of the face: corners, middles of edges, centre
  std::optional<Vec3> foot;    ///< of the pole
};

bool can_move(const studio::Fixture& fixture) {
  return std::holds_alternative<studio::StandMount>(fixture.mount) ||
         std::holds_alternative<studio::ArcMount>(fixture.mount) ||
         std::holds_alternative<studio::TrackMount>(fixture.mount);
}
/// The thesis's free lamp is an idea: it has no body and hides nothing.
bool has_body(const studio::Fixture& fixture) {
  return !std::holds_alternative<studio::VirtualMount>(fixture.mount);
}

Body body(const studio::Fixture& fixture, const core::FixtureState& state, const Geometry& geometry,
          double floor) {
  const Pose placed = pose(fixture, state, geometry.aim);
  Body out{placed.position, fixture.profile.body_radius, false, {}, {}};
  if (!fixture.modifiers.empty() && fixture.modifiers.front().width > 0) {
    const studio::Modifier& modifier = fixture.modifiers.front();
    const Vec3 level = cross(placed.direction, Vec3{0, 0, 1});
    const Vec3 right = length(level) > 1e-6 ? unit(level) : geometry.aim.camera_right;
    const Vec3 up = cross(right, placed.direction);
    out.face = true;
    for (std::size_t i = 0; i < 9; ++i)
      out.points[i] = placed.position +
                      0.5 * (static_cast<double>(i % 3) - 1) * modifier.width * right +
                      0.5 * (static_cast<double>(i / 3) - 1) * modifier.height * up;
  }
  const core::Spherical about = core::spherical(geometry.aim, placed.position);
  const bool boom = about.elevation > kBoomFrom && std::abs(about.azimuth) < core::kPi / 2;
  if (std::holds_alternative<studio::StandMount>(fixture.mount) && !boom)
    out.foot = Vec3{placed.position.x, placed.position.y, std::min(floor, placed.position.z)};
  return out;
}

/// The four side planes of a camera's picture, normals inwards, through its eye.
struct Frame {
  Vec3 eye, axis;
  std::array<Vec3, 4> sides;
};
Frame frame_of(const studio::Camera& camera) {
  Frame out;
  out.eye = camera.at;
  out.axis = unit(camera.look_at - camera.at);
  const Vec3 level = cross(out.axis, Vec3{0, 0, 1});
  const Vec3 right = length(level) > 1e-9 ? unit(level) : Vec3{1, 0, 0};
  const Vec3 up = cross(right, out.axis);
  const double v = std::tan(camera.vertical_fov / 2);
  const double h = v * camera.size.width / std::max(1, camera.size.height);
  out.sides = {unit(h * out.axis - right), unit(h * out.axis + right), unit(v * out.axis - up),
               unit(v * out.axis + up)};
  return out;
}

bool sphere_shows(const Frame& frame, Vec3 centre, double radius) {
  const Vec3 from = centre - frame.eye;
  if (dot(from, frame.axis) < -radius) return false;
  return std::all_of(frame.sides.begin(), frame.sides.end(),
                     [&](Vec3 side) { return dot(from, side) > -radius; });
}

/// Whether a segment as thick as `radius` enters the picture: cut by each side plane in turn.
bool segment_shows(const Frame& frame, Vec3 a, Vec3 b, double radius) {
  double from = 0, to = 1;
  const auto cut = [&](Vec3 side, double margin) {
    const double za = dot(a - frame.eye, side) + margin, zb = dot(b - frame.eye, side) + margin;
    if (za < 0 && zb < 0) return false;
    if (za < 0) from = std::max(from, za / (za - zb));
    if (zb < 0) to = std::min(to, za / (za - zb));
    return from <= to;
  };
  if (!cut(frame.axis, 0)) return false;
  return std::all_of(frame.sides.begin(), frame.sides.end(),
                     [&](Vec3 side) { return cut(side, radius); });
}

bool shows(const Frame& frame, const Body& body) {
  if (sphere_shows(frame, body.centre, body.radius)) return true;
  if (body.foot && segment_shows(frame, *body.foot, body.centre, kPole)) return true;
  if (!body.face) return false;
  // Rows and columns of the face: a picture's side cannot slip between them unseen by more than
  // half a modifier, and its corners and edges are caught.
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_shows(frame, body.points[3 * k], body.points[3 * k + 2], 0.02) ||
        segment_shows(frame, body.points[k], body.points[k + 6], 0.02))
      return true;
  return false;
}

double from_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / std::max(dot(along, along), 1e-12), 0.0, 1.0);
  return distance(p, a + t * along);
}

double from_box(Vec3 p, const core::Box3& box) {
  const Vec3 nearest{std::clamp(p.x, box.least.x, box.most.x),
                     std::clamp(p.y, box.least.y, box.most.y),
                     std::clamp(p.z, box.least.z, box.most.z)};
  return distance(p, nearest);
}

/// Between the eye and the subject: within the cone from the eye to the subject's ball.
bool blocks_view(const Frame& frame, const Body& body, const core::Box3& subject) {
  if (subject.empty()) return false;
  const Vec3 middle = subject.centre();
  const double ball = 0.5 * length(subject.extent());
  const double reach = distance(frame.eye, middle);
  const auto blocks = [&](Vec3 p, double radius) {
    const double along = dot(p - frame.eye, (middle - frame.eye) / std::max(reach, 1e-9));
    if (along < -radius || along > reach - ball) return false;
    return from_segment(p, frame.eye, middle) < radius + ball * std::max(along, 0.0) / reach;
  };
  if (blocks(body.centre, body.radius)) return true;
  return body.face &&
         std::any_of(body.points.begin(), body.points.end(), [&](Vec3 p) { return blocks(p, 0); });
}

/// How far a lamp's body reaches through a plane's rectangle, or whether it stands behind it.
bool passes(const studio::BackgroundPlane& plane, const core::AimFrame& aim, const Body& body) {
  const PlaneFrame frame = plane_frame(plane, aim);
  const double side = dot(aim.origin - frame.centre, frame.normal) < 0 ? -1 : 1;
  const double aim_height = side * dot(aim.origin - frame.centre, frame.normal);
  const double width = length(frame.right), height = length(frame.up);
  const auto within = [&](Vec3 p, double margin) {
    const Vec3 from = p - frame.centre;
    return std::abs(dot(from, frame.right)) <= width * (width + margin) &&
           std::abs(dot(from, frame.up)) <= height * (height + margin);
  };
  const auto through = [&](Vec3 p, double radius) {
    const double above = side * dot(p - frame.centre, frame.normal);
    if (above >= radius) return false;
    if (above > -radius) return within(p, radius);
    // Behind: the plane stands between lamp and subject.
    const double t = above / (above - aim_height);
    return within(p + t * (aim.origin - p), 0);
  };
  if (through(body.centre, body.radius)) return true;
  return body.face &&
         std::any_of(body.points.begin(), body.points.end(), [&](Vec3 p) { return through(p, 0); });
}

double reach(const Body& body) {
  return body.face ? std::max(body.radius, distance(body.centre, body.points[0])) : body.radius;
}

double apart(const Body& a, const Body& b) {
  const double centres = distance(a.centre, b.centre);
  // Most lamps stand far apart: no need to look closer.
  if (const double surely = centres - reach(a) - reach(b) - 0.05; surely > 0) return surely;
  double least = centres - a.radius - b.radius;
  if (a.face)
    for (const Vec3 p : a.points) least = std::min(least, distance(p, b.centre) - b.radius);
  if (b.face)
    for (const Vec3 p : b.points) least = std::min(least, distance(p, a.centre) - a.radius);
  if (a.face && b.face)
    for (const Vec3 p : a.points)
      for (const Vec3 q : b.points) least = std::min(least, distance(p, q) - 0.05);
  return least;
}

double highest(const Body& body) {
  double z = body.centre.z + body.radius;
  if (body.face)
    for (const Vec3 p : body.points) z = std::max(z, p.z);
  return z;
}

double from_sitter(const Body& body, const core::Box3& subject) {
  double least = from_box(body.centre, subject);
  if (body.face)
    for (const Vec3 p : body.points) least = std::min(least, from_box(p, subject));
  return least;
}

double floor_of(const studio::Studio& studio) {
  for (const studio::BackgroundPlane& plane : studio.background)
    if (plane.normal.z > 0.9 * length(plane.normal)) return plane.through.z;
  return 0;
}

}  // namespace

std::string infeasible(const studio::Studio& studio, const Geometry& geometry,
                       const studio::Rig& rig, std::size_t index) {
  const studio::Fixture& fixture = studio.fixtures[index];
  // A lamp that cannot be moved stands where it stands.
  if (!can_move(fixture)) return {};
  const double floor = floor_of(studio);
  const auto body_of = [&](std::size_t i) {
    const core::FixtureState state = i < rig.states.size() ? rig.states[i] : core::FixtureState{};
    return body(studio.fixtures[i], state, geometry, floor);
  };
  const Body own = body_of(index);
  const std::string& name = fixture.name;
  if (!geometry.subject_bounds.empty())
    if (const double gap = from_sitter(own, geometry.subject_bounds); gap < kLeastFromSitter)
      return fmt::format("{} would be {:.2f} m from the sitter, at least {:.1f} m is needed", name,
                         gap, kLeastFromSitter);
  if (studio.ceiling && highest(own) > *studio.ceiling)
    return fmt::format("{} would reach {:.2f} m up, the ceiling is at {:.2f} m", name, highest(own),
                       *studio.ceiling);
  for (const studio::BackgroundPlane& plane : studio.background)
    if (passes(plane, geometry.aim, own))
      return fmt::format("{} would stand in or behind the {}", name, plane.name);
  for (const studio::Camera& camera : studio.cameras) {
    const Frame frame = frame_of(camera);
    if (!camera.lamps_may_show && shows(frame, own))
      return fmt::format("{} would show in the picture of camera {}", name, camera.name);
    if (blocks_view(frame, own, geometry.subject_bounds))
      return fmt::format("{} would stand between camera {} and the subject", name, camera.name);
  }
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (i != index && has_body(studio.fixtures[i]) && apart(own, body_of(i)) < 0)
      return fmt::format("{} would stand in the way of {}", name, studio.fixtures[i].name);
  return {};
}

}  // namespace chiaro::twin
