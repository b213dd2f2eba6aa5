// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/studio.h"

#include <algorithm>

namespace chiaro::studio {

std::string_view name_of(Role role) {
  switch (role) {
    case Role::key:
      return "key";
    case Role::fill:
      return "fill";
    case Role::back:
      return "back";
    case Role::hair:
      return "hair";
    case Role::kicker:
      return "kicker";
    case Role::background:
      return "background";
    case Role::practical:
      return "practical";
  }
  return "";
}

std::optional<std::size_t> Studio::fixture_index(std::string_view wanted) const {
  const auto found = std::find_if(fixtures.begin(), fixtures.end(),
                                  [&](const Fixture& each) { return each.name == wanted; });
  if (found == fixtures.end()) return std::nullopt;
  return static_cast<std::size_t>(found - fixtures.begin());
}

const Fixture* Studio::fixture(std::string_view wanted) const {
  const auto index = fixture_index(wanted);
  return index ? &fixtures[*index] : nullptr;
}

std::vector<Deed> asked_of_brain(const Studio& studio) {
  std::vector<Deed> asks;
  for (const Surface& surface : studio.surfaces)
    for (const SurfaceControl& control : surface.map.controls)
      for (const Deed& deed : control.deeds)
        if (needs_brain(deed.kind)) asks.push_back(deed);
  return asks;
}

Rig placed_rig(const Studio& studio) {
  Rig rig;
  for (const Fixture& fixture : studio.fixtures) {
    core::FixtureState state = fixture.initial;
    const auto stand_at = [&](const core::Spherical& at) {
      state.set(core::Dof::azimuth, at.azimuth);
      state.set(core::Dof::elevation, at.elevation);
      state.set(core::Dof::distance, at.distance);
    };
    if (const auto* stand = std::get_if<StandMount>(&fixture.mount)) stand_at(stand->at);
    if (const auto* free = std::get_if<VirtualMount>(&fixture.mount)) stand_at(free->at);
    // A motor may be known to stand elsewhere than the file says.
    const auto motor_at = [&](core::Dof dof, double at) {
      if (!state.has(dof)) state.set(dof, at);
    };
    if (const auto* head = std::get_if<PanTiltMount>(&fixture.mount)) {
      motor_at(core::Dof::pan, head->pan.clamp(0));
      motor_at(core::Dof::tilt, head->tilt.clamp(0));
    }
    if (const auto* arc = std::get_if<ArcMount>(&fixture.mount)) motor_at(core::Dof::arc, arc->at);
    if (const auto* track = std::get_if<TrackMount>(&fixture.mount))
      motor_at(core::Dof::track, track->at);
    rig.states.push_back(state);
  }
  return rig;
}

double exposure_gain(const Exposure& exposure, const Camera& camera) {
  // An 18 % card must render as L* 50 when `lux` falls on it.
  constexpr double kCard = 0.18, kIncidentConstant = 250;  // ISO 2720, flat receptor
  double lux = exposure.grey_card.value;
  if (camera.shutter_s && camera.aperture_f && camera.iso)
    lux = kIncidentConstant * *camera.aperture_f * *camera.aperture_f /
          (*camera.shutter_s * *camera.iso);
  return core::luminance_of_lightness(50) / (kCard * lux);
}

}  // namespace chiaro::studio
