// SPDX-License-Identifier: Apache-2.0
// The hand as a program.
#pragma once

#include <span>
#include <string>

#include "controller/ports/world.h"

namespace chiaro::daemon {

/// `chiaro-output STUDIO [--dry-run] [--state DIR] [--on-stop release|hold] [--no-real-time]`,
/// without the program's name. The calling thread becomes the output loop. Exit codes: 0 stopped,
/// 1 the studio file has problems, 2 usage, 3 another hand runs or the runtime folder is closed.
ports::Exit run_output(std::span<const std::string> arguments, ports::World& world);

}  // namespace chiaro::daemon
