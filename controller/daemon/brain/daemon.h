// SPDX-License-Identifier: Apache-2.0
// The program chiarod.
#pragma once

#include <span>
#include <string>

#include "controller/ports/world.h"

namespace chiaro::daemon {

/// `chiarod STUDIO [--port N] [--listen ADDRESS] [--token T] [--web FOLDER]`, until world.stop.
/// Once it answers, prints "panel: http://127.0.0.1:8090/" on world.out.
ports::Exit run_daemon(std::span<const std::string> arguments, ports::World& world);

}  // namespace chiaro::daemon
