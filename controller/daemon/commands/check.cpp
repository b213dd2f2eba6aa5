// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "controller/daemon/command.h"

namespace chiaro::daemon {

void declare_check(CLI::App& app, ports::World&, Verdict&) {
  app.add_subcommand("check", "every problem of a studio file");
}

}  // namespace chiaro::daemon
