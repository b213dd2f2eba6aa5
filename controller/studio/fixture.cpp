// SPDX-License-Identifier: Apache-2.0
// What a fixture can do as it is fitted, patched and mounted.
#include <algorithm>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/studio.h"

namespace chiaro::studio {

using core::Dof;

Optic Fixture::fitted_optic() const {
  Optic optic = profile.optic;
  if (modifiers.empty() || modifiers.front().width <= 0) return optic;
  optic.kind = Optic::Kind::rectangle;
  optic.width = modifiers.front().width;
  optic.height = modifiers.front().height;
  return optic;
}

core::Candela Fixture::fitted_output() const {
  const double loss = modifiers.empty() ? 0 : modifiers.front().loss_stops;
  return core::from_stops(-loss) * output;
}

namespace {

bool on_the_wire(const Fixture& fixture, Dof dof) {
  if (std::holds_alternative<VirtualMount>(fixture.mount)) return true;
  if (std::holds_alternative<NoPatch>(fixture.patch)) return false;
  if (fixture.mode >= fixture.profile.modes.size()) return false;
  const auto& channels = fixture.profile.modes[fixture.mode].channels;
  // Without a dimmer channel the drives carry the level: every mode that lights can dim.
  if (dof == Dof::intensity) return true;
  return std::any_of(channels.begin(), channels.end(),
                     [&](const Channel& channel) { return channel.dof == dof; });
}

std::optional<core::Range> light_range(const Fixture& fixture, Dof dof) {
  const auto own = profiles::own_range(fixture.profile, dof);
  for (const HandBinding& binding : fixture.by_hand)
    if (binding.dof == dof) return binding.range ? binding.range : own;
  return on_the_wire(fixture, dof) ? own : std::nullopt;
}

}  // namespace

std::vector<std::pair<Dof, core::Range>> Fixture::ranges() const {
  std::vector<std::pair<Dof, core::Range>> all;
  if (!controlled) return all;
  for (const core::DofInfo& each : core::dofs())
    if (!core::is_placement(each.dof) || each.dof == Dof::zoom)
      if (auto range = light_range(*this, each.dof)) {
        if (each.dof == Dof::intensity) range->most = std::min(range->most, limits.most);
        all.emplace_back(each.dof, *range);
      }
  const auto move_within = [&](const Region& region) {
    all.emplace_back(Dof::azimuth, region.azimuth);
    all.emplace_back(Dof::elevation, region.elevation);
    all.emplace_back(Dof::distance, region.distance);
  };
  if (const auto* stand = std::get_if<StandMount>(&mount)) move_within(stand->region);
  if (const auto* free = std::get_if<VirtualMount>(&mount)) move_within(free->region);
  if (const auto* head = std::get_if<PanTiltMount>(&mount)) {
    all.emplace_back(Dof::pan, head->pan);
    all.emplace_back(Dof::tilt, head->tilt);
  }
  return all;
}

}  // namespace chiaro::studio
