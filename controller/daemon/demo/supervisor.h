// SPDX-License-Identifier: Apache-2.0
// Starts programs, starts them again when they die, and ends them all: what systemd is to an
// installed Chiaro, `chiaro demo` is to its own three processes.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::daemon {

struct Program {
  std::string name;  ///< "chiarod"
  std::filesystem::path file;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment;  ///< beside our own
};

/// One thread: the children die with it, even when it is killed, so that none is left behind. They
/// have process groups of their own: a terminal's Ctrl-C reaches us alone, and we end them in
/// order.
class Supervisor {
 public:
  /// What programs print goes to `<logs>/<name>.log`, written afresh.
  explicit Supervisor(std::filesystem::path logs);
  /// As end().
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  core::Result<core::Done> start(const Program& program, ports::TimePoint now);
  /// Restarts who has died. A program that dies five times within ten seconds, or says by its exit
  /// code that it cannot run like this (1 to 3), is a problem that ends the demo, with its last
  /// words.
  core::Result<core::Done> tend(ports::TimePoint now);
  /// Asks each to end, the last started first, and waits; kills who does not end in 5 s.
  void end();

  /// Nothing when it does not run now.
  std::optional<pid_t> pid(const std::string& name) const;
  int restarts(const std::string& name) const;

 private:
  struct Child {
    Program program;
    pid_t pid = -1;
    int restarts = 0;
    ports::TimePoint due;  ///< when to start again, while pid is -1
    std::vector<ports::TimePoint> deaths;
  };
  core::Result<core::Done> launch(Child& child, bool afresh) const;
  core::Result<core::Done> after_death(Child& child, int status, ports::TimePoint now) const;
  std::string last_words(const Child& child) const;
  std::filesystem::path log_of(const Child& child) const;

  std::filesystem::path logs_;
  std::vector<Child> children_;
};

}  // namespace chiaro::daemon
