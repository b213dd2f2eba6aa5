// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/stagehand.h"

#include <nlohmann/json.hpp>

namespace chiaro::simulator {
namespace {

using Json = nlohmann::json;

core::FixtureState placement_in(const Json& to) {
  core::FixtureState state;
  for (const auto& [name, value] : to.items()) {
    const auto dof = core::dof_named(name);
    if (dof && core::is_placement(*dof) && value.is_number())
      state.set(*dof, core::inside_value(*dof, value.get<double>()));
  }
  return state;
}

/// One task per object in the list `list` that has a place under `place`.
core::Result<std::vector<Task>> read(const std::string& state_json, const char* list,
                                     const char* name, const char* place) {
  const auto state = Json::parse(state_json, nullptr, false);
  if (!state.is_object() || !state.contains(list) || !state[list].is_array())
    return core::Problem{{}, "the daemon's state is not the JSON that it should be", ""};
  std::vector<Task> tasks;
  for (const auto& one : state[list]) {
    const bool whole = one.is_object() && one.contains(name) && one[name].is_string() &&
                       one.contains(place) && one[place].is_object();
    if (whole) tasks.push_back({one[name].get<std::string>(), placement_in(one[place])});
  }
  return tasks;
}

}  // namespace

core::Result<std::vector<Task>> tasks_in(const std::string& state_json) {
  return read(state_json, "instructions", "fixture", "to");
}

core::Result<std::vector<Task>> places_in(const std::string& state_json) {
  return read(state_json, "fixtures", "name", "placed");
}

std::string placed_json(const core::FixtureState& to) {
  Json json = Json::object();
  for (const auto& dof : core::dofs())
    if (to.has(dof.dof))
      json[std::string(dof.file_name)] = core::file_value(dof.dof, to.get(dof.dof));
  return json.dump();
}

std::optional<Task> Stagehand::work(const std::vector<Task>& tasks, ports::TimePoint now) {
  if (tasks.empty()) {
    doing_.reset();
    return std::nullopt;
  }
  if (!doing_ || !(*doing_ == tasks.front())) {
    doing_ = tasks.front();
    since_ = now;
  }
  if (now - since_ < time_per_stand_) return std::nullopt;
  return std::exchange(doing_, std::nullopt);
}

}  // namespace chiaro::simulator
