// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/last_levels.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/output/whole_file.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

Json json_of(const core::FixtureState& state) {
  Json values = Json::object();
  for (const auto& dof : core::dofs())
    if (state.has(dof.dof)) values[std::string(dof.name)] = state.get(dof.dof);
  return values;
}

core::FixtureState state_of(const Json& values) {
  core::FixtureState state;
  if (!values.is_object()) return state;
  for (const auto& [name, value] : values.items())
    if (const auto dof = core::dof_named(name); dof && value.is_number())
      state.set(*dof, value.get<double>());
  return state;
}

}  // namespace

core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held) {
  Json json;
  json["about"] = "levels that chiaro-output sends when it starts; inside units (radians, kelvin)";
  json["studio"] = studio.name;
  json["blackout"] = held.blackout;
  json["masters"] = held.masters;
  for (std::size_t i = 0; i < studio.fixtures.size() && i < held.fixtures.size(); ++i)
    json["fixtures"][studio.fixtures[i].name] = json_of(held.fixtures[i]);
  return write_whole(file, json.dump(1) + "\n");
}

std::optional<rig::Held> read_last_levels(const std::filesystem::path& file,
                                          const studio::Studio& studio, core::Problems& warnings) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  std::stringstream text;
  text << in.rdbuf();
  const Json json = Json::parse(text.str(), nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains("fixtures") ||
      !json["fixtures"].is_object()) {
    warnings.push_back({{file.string()},
                        "the levels kept from last time cannot be read",
                        "starting as the studio file says; the file will be written anew",
                        true});
    return std::nullopt;
  }
  if (json.value("studio", Json()) != Json(studio.name)) return std::nullopt;
  rig::Held held;
  const Json blackout = json.value("blackout", Json());
  held.blackout = blackout.is_boolean() && blackout.get<bool>();
  const Json masters = json.value("masters", Json::array());
  for (std::size_t i = 0; i < held.masters.size() && i < masters.size(); ++i)
    if (masters[i].is_number()) held.masters[i] = masters[i].get<double>();
  for (const auto& fixture : studio.fixtures) {
    const auto found = json["fixtures"].find(fixture.name);
    held.fixtures.push_back(found == json["fixtures"].end() ? core::FixtureState{}
                                                            : state_of(*found));
  }
  return held;
}

}  // namespace chiaro::daemon
