// SPDX-License-Identifier: Apache-2.0
// Everything a program touches outside itself. Each program is `run(arguments, world)` plus a
// ten-line main, so that tests run brain, hand and simulator in one process on one fake clock.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "controller/ports/clock.h"
#include "controller/ports/devices.h"
#include "controller/ports/network.h"

namespace chiaro::ports {

/// The command-line contract's exit codes.
enum class Exit : int {
  done = 0,
  input_has_problems = 1,
  usage = 2,
  out_of_reach = 3,
  internal_fault = 4
};

struct World {
  Clock& clock;
  Network& network;
  Devices& devices;
  std::istream& in;
  std::ostream& out;  ///< results; with --json one object
  std::ostream& err;  ///< people's text and progress
  bool err_is_terminal = false;
  std::filesystem::path config_folder;   ///< shipped fixtures, moods, studios, subjects
  std::filesystem::path state_folder;    ///< survives a restart: looks, last levels, CID, caches
  std::filesystem::path runtime_folder;  ///< does not: boxes, control socket
  const std::atomic<bool>& stop;         ///< SIGINT, SIGTERM
  std::atomic<bool>& reload;             ///< SIGHUP; the program clears it
};

}  // namespace chiaro::ports
