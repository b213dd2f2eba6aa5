// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/lamp.h"

#include <algorithm>

#include "controller/rig/fade.h"

namespace chiaro::rig {

using core::Dof;

namespace {

std::optional<Master> master_of(studio::Role role) {
  switch (role) {
    case studio::Role::key:
      return Master::key;
    case studio::Role::fill:
      return Master::fill;
    case studio::Role::back:
    case studio::Role::hair:
    case studio::Role::kicker:
      return Master::back;
    case studio::Role::background:
      return Master::background;
    case studio::Role::practical:
      return std::nullopt;
  }
  return std::nullopt;
}

/// A zoom stays inside its lamp: nobody is hurt by it, and no arming is asked for it.
bool is_motor(const studio::Fixture& fixture, Dof dof) {
  if (!core::is_placement(dof) || dof == Dof::zoom) return false;
  if (std::holds_alternative<studio::StandMount>(fixture.mount)) return false;
  return std::none_of(fixture.by_hand.begin(), fixture.by_hand.end(),
                      [&](const studio::HandBinding& hand) { return hand.dof == dof; });
}

double starting_value(const studio::Fixture& fixture, const core::FixtureState& placed, Dof dof,
                      bool dark, double safe) {
  if (dof == Dof::intensity && dark) return safe;
  if (dof == Dof::cct && !placed.has(dof)) return fixture.profile.emitter.cct.value;
  return placed.get(dof, is_light(dof) && dof != Dof::intensity ? 1 : 0);
}

}  // namespace

Lamp lamp_of(const studio::Fixture& fixture, const core::FixtureState& placed, bool dark) {
  Lamp lamp;
  lamp.slew_per_s = fixture.limits.slew_per_s;
  lamp.safe = std::clamp(fixture.limits.safe_level, 0.0, fixture.limits.most);
  lamp.ignores_blackout = fixture.limits.ignores_blackout;
  lamp.master = master_of(fixture.role);
  if (!fixture.controlled) return lamp;
  auto ranges = fixture.ranges();
  ranges.emplace_back(Dof::intensity, core::Range{0, 1});
  for (const auto& [dof, range] : ranges) {
    const auto d = core::index_of(dof);
    lamp.has |= 1u << d;
    lamp.range[d] = range;
    if (dof == Dof::intensity) lamp.range[d] = {0, std::clamp(fixture.limits.most, 0.0, 1.0)};
    if (is_motor(fixture, dof)) {
      lamp.axes |= 1u << d;
      lamp.speed[d] = (range.most - range.least) / fixture.limits.end_to_end_s;
    }
    lamp.base.set(dof, lamp.range[d].clamp(starting_value(fixture, placed, dof, dark, lamp.safe)));
  }
  return lamp;
}

}  // namespace chiaro::rig
