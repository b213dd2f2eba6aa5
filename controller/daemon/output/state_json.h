// SPDX-License-Identifier: Apache-2.0
// A lamp's values in the hand's own files: by the DOF's name, inside units.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "controller/core/dof.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// One line, or indented; text that is not whole UTF-8 (a client may send anything) is mended,
/// never thrown at whoever asked.
std::string text_of(const nlohmann::json& json, int indent = -1);

nlohmann::json json_of(const core::FixtureState& state);
/// Names and values that are none are passed over.
core::FixtureState state_of(const nlohmann::json& values);

/// {fixture: {dof: value}}, and back by name; a fixture that is not named has no value.
nlohmann::json json_of(const studio::Studio& studio, const std::vector<core::FixtureState>& states);
std::vector<core::FixtureState> states_of(const studio::Studio& studio,
                                          const nlohmann::json& fixtures);

}  // namespace chiaro::daemon
