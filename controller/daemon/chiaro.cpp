// SPDX-License-Identifier: Apache-2.0
// The command line: collects the verbs, runs one, turns faults into the contract's exit codes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <ostream>
#include <vector>

#include "controller/daemon/command.h"

namespace chiaro::daemon {

ports::Exit run_chiaro(std::span<const std::string> arguments, ports::World& world) {
  CLI::App app{"Chiaro lights real studios by example.", "chiaro"};
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "help of every command");
  app.fallthrough();
  Verdict verdict;
  app.add_flag("--json", verdict.json, "print one JSON object on standard output");
#define COMMAND(name, summary) declare_##name(app, world, verdict);
#include "controller/daemon/commands.def"
#undef COMMAND
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // CLI11 wants it so
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error, world.out, world.err);
    return code == 0 ? ports::Exit::done : ports::Exit::usage;
  } catch (const std::exception& fault) {
    world.err << "chiaro: internal fault: " << fault.what()
              << "\nThis is a bug in Chiaro: please report it with the command line above.\n";
    return ports::Exit::internal_fault;
  }
  return verdict.exit;
}

}  // namespace chiaro::daemon
