// SPDX-License-Identifier: Apache-2.0
// Photographs that people send: read where nobody waits for it, and kept small. The light is the
// same in two megapixels as in fifty.
#pragma once

#include "controller/daemon/brain/planner.h"

namespace chiaro::daemon {

/// The bytes of a picture as they are kept: as they came when that is small enough, else made
/// smaller. Problems: it cannot be read. Takes up to a second. Thread-safe.
core::Result<std::string> kept_picture(std::string bytes, const std::string& name);

/// Reads a picture when the planner comes to it.
GoalReader goal_like(std::string bytes, std::string name, design::Objective objective);

}  // namespace chiaro::daemon
