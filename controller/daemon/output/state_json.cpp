// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/state_json.h"

#include <nlohmann/json.hpp>

namespace chiaro::daemon {

using Json = nlohmann::json;

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

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

Json json_of(const studio::Studio& studio, const std::vector<core::FixtureState>& states) {
  Json fixtures = Json::object();
  for (std::size_t i = 0; i < studio.fixtures.size() && i < states.size(); ++i)
    fixtures[studio.fixtures[i].name] = json_of(states[i]);
  return fixtures;
}

std::vector<core::FixtureState> states_of(const studio::Studio& studio, const Json& fixtures) {
  std::vector<core::FixtureState> states;
  for (const auto& fixture : studio.fixtures) {
    const auto found = fixtures.find(fixture.name);
    states.push_back(found == fixtures.end() ? core::FixtureState{} : state_of(*found));
  }
  return states;
}

}  // namespace chiaro::daemon
