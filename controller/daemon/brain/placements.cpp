// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/placements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace chiaro::daemon {
namespace {

using Json = nlohmann::ordered_json;
using core::Dof;
constexpr std::array kPlace{Dof::azimuth, Dof::elevation, Dof::distance};

core::FixtureState file_place(const studio::Fixture& fixture) {
  core::FixtureState state;
  for (const studio::HandBinding& binding : fixture.by_hand)
    if (fixture.initial.has(binding.dof)) state.set(binding.dof, fixture.initial.get(binding.dof));
  const core::Spherical* at = nullptr;
  if (const auto* stand = std::get_if<studio::StandMount>(&fixture.mount)) at = &stand->at;
  if (const auto* free = std::get_if<studio::VirtualMount>(&fixture.mount)) at = &free->at;
  if (at == nullptr) return state;
  state.set(Dof::azimuth, at->azimuth);
  state.set(Dof::elevation, at->elevation);
  state.set(Dof::distance, at->distance);
  return state;
}

Json json_of(const core::FixtureState& state) {
  Json json = Json::array();
  for (const Dof dof : kPlace) json.push_back(state.get(dof));
  return json;
}

/// The short way round for azimuths.
double difference(Dof dof, double a, double b) {
  return dof == Dof::azimuth ? std::remainder(a - b, 2 * core::kPi) : a - b;
}

/// Knobs, gels and flash powers under their names in files.
Json hand_of(const studio::Fixture& fixture, const core::FixtureState& placed) {
  Json json = Json::object();
  for (const studio::HandBinding& binding : fixture.by_hand)
    if (placed.has(binding.dof) && !core::is_placement(binding.dof))
      json[std::string(core::info(binding.dof).file_name)] = placed.get(binding.dof);
  return json;
}

void read_hand(const Json& json, const studio::Fixture& fixture, core::FixtureState& placed) {
  if (!json.is_object()) return;
  for (const studio::HandBinding& binding : fixture.by_hand) {
    const std::string name(core::info(binding.dof).file_name);
    if (json.contains(name) && json[name].is_number())
      placed.set(binding.dof, json[name].get<double>());
  }
}

bool read(const Json& json, core::FixtureState& state) {
  if (!json.is_array() || json.size() != kPlace.size()) return false;
  for (std::size_t i = 0; i < kPlace.size(); ++i) {
    if (!json[i].is_number()) return false;
    state.set(kPlace[i], json[i].get<double>());
  }
  return true;
}

bool same_place(const core::FixtureState& a, const core::FixtureState& b) {
  return std::all_of(kPlace.begin(), kPlace.end(),
                     [&](Dof dof) { return a.get(dof) == b.get(dof); });
}

}  // namespace

Placements::Placements(const studio::Studio& studio, const std::string& json) {
  const Json kept = Json::parse(json, nullptr, false);
  for (const studio::Fixture& fixture : studio.fixtures) {
    core::FixtureState place = file_place(fixture);
    bool is_locked = false;
    std::optional<core::Candela> measured;
    if (kept.is_object() && kept.contains(fixture.name) && kept[fixture.name].is_object()) {
      const Json& entry = kept[fixture.name];
      core::FixtureState from, now;
      const bool readable = entry.contains("from") && entry.contains("at") &&
                            read(entry["from"], from) && read(entry["at"], now);
      if (readable && place.has(Dof::azimuth) && same_place(from, place)) place.overlay(now);
      if (entry.contains("hand")) read_hand(entry["hand"], fixture, place);
      is_locked = entry.value("locked", false);
      if (entry.contains("output_cd") && entry["output_cd"].is_number())
        measured = core::Candela{entry["output_cd"].get<double>()};
    }
    placed_.push_back(place);
    locked_.push_back(is_locked);
    measured_.push_back(measured);
  }
}

std::string Placements::to_json(const studio::Studio& studio) const {
  Json json = Json::object();
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    Json entry = {{"locked", static_cast<bool>(locked_[i])}};
    if (const Json hand = hand_of(studio.fixtures[i], placed_[i]); !hand.empty())
      entry["hand"] = hand;
    if (measured_[i]) entry["output_cd"] = measured_[i]->value;
    if (placed_[i].has(Dof::azimuth)) {
      entry["from"] = json_of(file_place(studio.fixtures[i]));
      entry["at"] = json_of(placed_[i]);
    }
    json[studio.fixtures[i].name] = entry;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

studio::Studio Placements::placed_studio(const studio::Studio& studio) const {
  studio::Studio placed = studio;
  for (std::size_t i = 0; i < placed.fixtures.size(); ++i) {
    studio::Fixture& fixture = placed.fixtures[i];
    for (const studio::HandBinding& binding : fixture.by_hand)
      if (placed_[i].has(binding.dof) && !core::is_placement(binding.dof))
        fixture.initial.set(binding.dof, placed_[i].get(binding.dof));
    if (measured_[i]) fixture.output = *measured_[i];
    if (!placed_[i].has(Dof::azimuth)) continue;
    const core::Spherical at{placed_[i].get(Dof::azimuth), placed_[i].get(Dof::elevation),
                             placed_[i].get(Dof::distance)};
    if (auto* stand = std::get_if<studio::StandMount>(&fixture.mount)) stand->at = at;
    if (auto* free = std::get_if<studio::VirtualMount>(&fixture.mount)) free->at = at;
  }
  return placed;
}

bool is_set(const studio::HandBinding& binding, const core::FixtureState& wanted,
            const core::FixtureState& placed) {
  if (!wanted.has(binding.dof)) return true;
  const double to = wanted.get(binding.dof), now = placed.get(binding.dof);
  if (binding.dof == Dof::cct) return std::fabs(to - now) <= 75;
  if (binding.kind == studio::HandKind::flash_power)  // a sixth of a stop
    return (to < 0.005 && now < 0.005) ||
           (now > 0 && to > 0 && std::fabs(std::log2(to / now)) < 1.0 / 6);
  return std::fabs(to - now) <= 0.05 * std::max(1.0, std::fabs(to));
}

bool stands_there(const core::FixtureState& wanted, const core::FixtureState& placed) {
  const auto near = [&](Dof dof, double tolerance) {
    return !wanted.has(dof) || !placed.has(dof) ||
           std::fabs(difference(dof, wanted.get(dof), placed.get(dof))) <= tolerance;
  };
  return near(Dof::azimuth, core::radians(1)) && near(Dof::elevation, core::radians(1)) &&
         near(Dof::distance, 0.03);
}

}  // namespace chiaro::daemon
