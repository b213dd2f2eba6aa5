// SPDX-License-Identifier: Apache-2.0
// The program chiaro-sim: a studio made of software that a daemon cannot tell from lamps on a wire
// and an IP camera.
#pragma once

#include <span>
#include <string>

#include "controller/ports/world.h"

namespace chiaro::simulator {

/// The command line without the program's name. Runs until world.stop.
ports::Exit run_sim(std::span<const std::string> arguments, ports::World& world);

}  // namespace chiaro::simulator
