// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/keep_out.h"

#include <algorithm>
#include <cmath>

namespace chiaro::rig {

using core::Dof;
using core::Vec3;

namespace {

double distance_to_line(Vec3 point, Vec3 foot, Vec3 head) {
  const Vec3 way = head - foot;
  const double square = dot(way, way);
  const double x = square > 0 ? std::clamp(dot(point - foot, way) / square, 0.0, 1.0) : 0;
  return core::distance(point, foot + x * way);
}

double height_of(const studio::Subject& subject) {
  if (subject.height) return *subject.height;
  return subject.eye_height > 0 ? subject.eye_height + 0.15 : 0.6;
}

}  // namespace

KeepOut::KeepOut(const studio::Studio& studio) {
  for (const auto& subject : studio.subjects)
    spaces_.push_back({subject.at, subject.at + Vec3{0, 0, height_of(subject)}, kPersonalSpace});
  for (const auto& zone : studio.keep_out) spaces_.push_back({zone.at, zone.at, zone.radius});
  core::AimFrame aim;
  if (!studio.subjects.empty() && !studio.cameras.empty()) {
    const auto& subject = studio.subjects.front();
    aim = core::aim_frame(subject.aim.value_or(subject.at), studio.main_camera().at);
  }
  for (const auto& fixture : studio.fixtures) rails_.push_back(rail_of(fixture, aim));
}

KeepOut::Rail KeepOut::rail_of(const studio::Fixture& fixture, const core::AimFrame& aim) {
  Rail rail;
  rail.body = fixture.profile.body_radius;
  if (const auto* arc = std::get_if<studio::ArcMount>(&fixture.mount)) {
    rail.carries = rail.is_arc = true;
    rail.origin = arc->centre;
    rail.along = arc->radius * aim.towards_camera;
    rail.up = arc->radius * (arc->vertical ? Vec3{0, 0, 1} : aim.camera_right);
    rail.at = arc->at;
  }
  if (const auto* track = std::get_if<studio::TrackMount>(&fixture.mount)) {
    rail.carries = true;
    rail.origin = track->from;
    rail.along = track->to - track->from;
    rail.at = track->at;
  }
  return rail;
}

Vec3 KeepOut::place(const Rail& rail, const core::FixtureState& state) {
  if (!rail.is_arc) return rail.origin + state.get(Dof::track, rail.at) * rail.along;
  const double angle = state.get(Dof::arc, rail.at);
  return rail.origin + std::cos(angle) * rail.along + std::sin(angle) * rail.up;
}

bool KeepOut::may_go(std::size_t i, const core::FixtureState& from,
                     const core::FixtureState& to) const {
  const Rail& rail = rails_[i];
  if (!rail.carries) return true;
  const Vec3 here = place(rail, from), there = place(rail, to);
  return std::all_of(spaces_.begin(), spaces_.end(), [&](const Space& space) {
    const double next = distance_to_line(there, space.foot, space.head);
    return next >= space.radius + rail.body ||
           next >= distance_to_line(here, space.foot, space.head);
  });
}

}  // namespace chiaro::rig
