// SPDX-License-Identifier: Apache-2.0
// The world of a real process.
#pragma once

#include "controller/ports/world.h"

namespace chiaro::drivers {

/// Real clock, network, streams and folders (CHIARO_CONFIG, CHIARO_STATE and CHIARO_RUNTIME
/// override them), signal handlers installed. Lives as long as the process.
ports::World& real_world(const char* program_path);

}  // namespace chiaro::drivers
