// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/placements.h"

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

bool read(const Json& json, core::FixtureState& state) {
  if (!json.is_array() || json.size() != kPlace.size()) return false;
  for (std::size_t i = 0; i < kPlace.size(); ++i) {
    if (!json[i].is_number()) return false;
    state.set(kPlace[i], json[i].get<double>());
  }
  return true;
}

}  // namespace

Placements::Placements(const studio::Studio& studio, const std::string& json) {
  const Json kept = Json::parse(json, nullptr, false);
  for (const studio::Fixture& fixture : studio.fixtures) {
    core::FixtureState place = file_place(fixture);
    bool is_locked = false;
    if (kept.is_object() && kept.contains(fixture.name) && kept[fixture.name].is_object()) {
      const Json& entry = kept[fixture.name];
      core::FixtureState from, now;
      const bool readable = entry.contains("from") && entry.contains("at") &&
                            read(entry["from"], from) && read(entry["at"], now);
      if (readable && place.present() != 0 && from == place) place = now;
      is_locked = entry.value("locked", false);
    }
    placed_.push_back(place);
    locked_.push_back(is_locked);
  }
}

std::string Placements::to_json(const studio::Studio& studio) const {
  Json json = Json::object();
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    Json entry = {{"locked", static_cast<bool>(locked_[i])}};
    if (placed_[i].present() != 0) {
      entry["from"] = json_of(file_place(studio.fixtures[i]));
      entry["at"] = json_of(placed_[i]);
    }
    json[studio.fixtures[i].name] = entry;
  }
  return json.dump();
}

studio::Studio Placements::placed_studio(const studio::Studio& studio) const {
  studio::Studio placed = studio;
  for (std::size_t i = 0; i < placed.fixtures.size(); ++i) {
    if (!placed_[i].has(Dof::azimuth)) continue;
    const core::Spherical at{placed_[i].get(Dof::azimuth), placed_[i].get(Dof::elevation),
                             placed_[i].get(Dof::distance)};
    if (auto* stand = std::get_if<studio::StandMount>(&placed.fixtures[i].mount)) stand->at = at;
    if (auto* free = std::get_if<studio::VirtualMount>(&placed.fixtures[i].mount)) free->at = at;
  }
  return placed;
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
