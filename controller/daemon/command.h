// SPDX-License-Identifier: Apache-2.0
// The verbs of `chiaro`, one file each in commands/ and one line each in commands.def.
#pragma once

#include <span>
#include <string>

#include "controller/ports/world.h"

namespace CLI {
class App;
}

namespace chiaro::daemon {

/// What a verb leaves behind for main.
struct Verdict {
  ports::Exit exit = ports::Exit::done;
  bool json = false;  ///< --json was given: one JSON object on world.out, all else on world.err
};

/// Adds the verb with its options to `app`; the callback runs it and sets `verdict.exit`.
using Declare = void (*)(CLI::App& app, ports::World& world, Verdict& verdict);

#define COMMAND(name, summary) \
  void declare_##name(CLI::App& app, ports::World& world, Verdict& verdict);
#include "controller/daemon/commands.def"
#undef COMMAND

/// The whole command line, without the program's name.
ports::Exit run_chiaro(std::span<const std::string> arguments, ports::World& world);

}  // namespace chiaro::daemon
