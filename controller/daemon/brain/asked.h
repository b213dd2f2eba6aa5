// SPDX-License-Identifier: Apache-2.0
// How a look was asked for, as the store keeps it beside the look: enough to solve it again after
// a stand has been moved, also in another run of the program.
#pragma once

#include <string>

#include "controller/design/nudge.h"
#include "controller/panel/gestures.h"

namespace chiaro::daemon {

/// Without the picture's bytes: they are the record's reference.
std::string asked_to_json(const panel::StartDesign& ask);
/// An empty ask (no mood, no picture, not ideal) when the text says nothing that can be solved.
panel::StartDesign asked_from_json(const std::string& json, const std::string& reference);
/// Stops as the design engine counts them: quarter steps.
design::Nudge steps_of(const panel::Nudges& nudges);
bool can_be_solved(const panel::StartDesign& ask);

}  // namespace chiaro::daemon
