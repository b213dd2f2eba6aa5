// SPDX-License-Identifier: Apache-2.0
// How every verb tells a person, or a script, what is wrong with its input.
#pragma once

#include <string>

#include "controller/core/result.h"
#include "controller/ports/world.h"

namespace chiaro::daemon {

/// Prints every problem on `err` and, with `json`, {"ok": false, "problems": […]} on `out`.
/// Always answers input_has_problems, for `return refuse(…)`.
ports::Exit refuse(const core::Problems& problems, ports::World& world, bool json);

/// The list as JSON text: [{"file", "line", "column", "what", "remedy", "warning"}, …].
std::string problems_to_json(const core::Problems& problems);

}  // namespace chiaro::daemon
