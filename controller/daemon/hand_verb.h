// SPDX-License-Identifier: Apache-2.0
// Verbs that speak to the hand itself: one line there, its answer for people or as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "controller/daemon/command.h"

namespace chiaro::daemon {

/// Asks and tells. `in_words` says the answer to people; with --json the answer itself is printed.
/// Exit: done, or 1 when the hand refused, or 3 when it is out of reach.
ports::Exit ask_hand(ports::World& world, bool json, const std::string& line,
                     std::string (*in_words)(const nlohmann::json& answer));

}  // namespace chiaro::daemon
