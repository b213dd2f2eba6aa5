// SPDX-License-Identifier: Apache-2.0
// Shared by the panel's sources: JSON of the core's values. Included by sources only: the JSON
// library is heavy.
#pragma once

#include <nlohmann/json.hpp>

#include "controller/core/dof.h"
#include "controller/core/result.h"

namespace chiaro::panel {

using Json = nlohmann::ordered_json;

/// Every present degree of freedom under its file name, in file units, rounded to nine significant
/// digits: 24-bit levels stay apart, and -47.00000000000001 does not show.
Json json_of(const core::FixtureState& state);
Json json_of(const core::Problem& problem);

}  // namespace chiaro::panel
