// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "controller/twin/scene.h"

namespace chiaro::twin {
namespace {

using core::Dof;
using core::Vec3;

template <class... F>
struct Each : F... {
  using F::operator()...;
};
template <class... F>
Each(F...) -> Each<F...>;

Vec3 unit_or_down(Vec3 v) { return length(v) > 1e-9 ? unit(v) : Vec3{0, 0, -1}; }

Pose about_aim(const core::Spherical& placed, const core::FixtureState& state,
               const core::AimFrame& aim) {
  const core::Spherical place{state.get(Dof::azimuth, placed.azimuth),
                              state.get(Dof::elevation, placed.elevation),
                              state.get(Dof::distance, placed.distance)};
  const Vec3 at = position(aim, place);
  return {at, unit_or_down(aim.origin - at)};
}

/// A moving head's beam: neutral aim turned by pan about the upright, then tilted.
Vec3 panned(const studio::PanTiltMount& mount, const core::FixtureState& state) {
  const Vec3 neutral = unit_or_down(mount.aim_at - mount.at);
  const double azimuth = std::atan2(neutral.y, neutral.x) + state.get(Dof::pan);
  const double elevation =
      std::atan2(neutral.z, std::hypot(neutral.x, neutral.y)) + state.get(Dof::tilt);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

Vec3 on_arc(const studio::ArcMount& mount, const core::FixtureState& state,
            const core::AimFrame& aim) {
  const double angle = state.get(Dof::arc, mount.at);
  const double c = mount.radius * std::cos(angle), s = mount.radius * std::sin(angle);
  return mount.vertical ? mount.centre + c * aim.towards_camera + Vec3{0, 0, s}
                        : mount.centre + c * aim.towards_camera + s * aim.camera_right;
}

}  // namespace

Pose pose(const studio::Fixture& fixture, const core::FixtureState& state,
          const core::AimFrame& aim) {
  return std::visit(
      Each{[&](const studio::FixedMount& m) -> Pose {
             return {m.at, unit_or_down(m.aim_at - m.at)};
           },
           [&](const studio::StandMount& m) -> Pose { return about_aim(m.at, state, aim); },
           [&](const studio::VirtualMount& m) -> Pose { return about_aim(m.at, state, aim); },
           [&](const studio::PanTiltMount& m) -> Pose {
             return {m.at, panned(m, state)};
           },
           [&](const studio::ArcMount& m) -> Pose {
             const Vec3 at = on_arc(m, state, aim);
             return {at, unit_or_down(aim.origin - at)};
           },
           [&](const studio::TrackMount& m) -> Pose {
             const Vec3 at = m.from + state.get(Dof::track, m.at) * (m.to - m.from);
             return {at, unit_or_down(aim.origin - at)};
           }},
      fixture.mount);
}

Light light(const studio::Fixture& fixture, const core::FixtureState& state,
            const core::AimFrame& aim, core::Kelvin balance) {
  const studio::Optic optic = fixture.fitted_optic();
  const Pose placed = pose(fixture, state, aim);
  Light out;
  out.kind = optic.kind;
  out.attenuation = optic.attenuation;
  out.position = placed.position;
  out.direction = placed.direction;
  // A softbox hangs level: its right is horizontal; straight down, towards the camera's right.
  const Vec3 level = cross(placed.direction, Vec3{0, 0, 1});
  out.right = length(level) > 1e-6 ? unit(level) : aim.camera_right;
  out.up = cross(out.right, placed.direction);
  out.candela = fixture.fitted_output().value;
  const double beam = state.get(Dof::zoom, optic.beam);
  const double field = optic.field + (beam - optic.beam);
  out.cos_beam = std::cos(beam / 2);
  out.cos_field = std::cos(std::fmin(std::fmax(field, beam), 2 * core::kPi) / 2);
  out.width = optic.width;
  out.height = optic.height;
  out.radius = optic.radius;
  out.colour = studio::light_colour(fixture, state, balance);
  return out;
}

Scene lit_by(const studio::Studio& studio, std::shared_ptr<const Geometry> geometry,
             const studio::Rig& rig) {
  Scene scene;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const core::FixtureState state = i < rig.states.size() ? rig.states[i] : core::FixtureState{};
    scene.lights.push_back(
        light(studio.fixtures[i], state, geometry->aim, studio.exposure.white_balance));
    scene.lights.back().fixture = i;
    scene.levels.push_back(
        state.get(Dof::intensity, studio.fixtures[i].initial.get(Dof::intensity)));
  }
  scene.geometry = std::move(geometry);
  if (studio.ambient)
    scene.ambient_irradiance =
        studio.ambient->illuminance.value *
        core::white_light(studio.ambient->cct, 0, studio.exposure.white_balance);
  scene.exposure_gain = studio::exposure_gain(studio.exposure, studio.main_camera());
  return scene;
}

}  // namespace chiaro::twin
