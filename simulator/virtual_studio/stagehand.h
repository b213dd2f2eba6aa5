// SPDX-License-Identifier: Apache-2.0
// The person who moves the stands, made of software: reads the daemon's instructions, takes its
// time, moves the virtual stand and says so.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::simulator {

/// One instruction of the daemon: put this fixture there.
struct Task {
  std::string fixture;
  core::FixtureState to;
  friend bool operator==(const Task&, const Task&) = default;
};
/// The instructions in the daemon's state (its JSON is documented in controller/panel/state.h).
core::Result<std::vector<Task>> tasks_in(const std::string& state_json);
/// Where the daemon believes each stand to be: a virtual studio that starts afterwards puts them
/// there, as real stands would still stand there.
core::Result<std::vector<Task>> places_in(const std::string& state_json);
/// The body that answers an instruction.
std::string placed_json(const core::FixtureState& to);

/// Decides when which stand has arrived. Time is an argument; one stand at a time, in the order
/// given. An instruction that changes before it is carried out starts afresh.
class Stagehand {
 public:
  explicit Stagehand(ports::Duration time_per_stand) : time_per_stand_(time_per_stand) {}
  /// What has been carried out by `now`, given the newest instructions.
  std::optional<Task> work(const std::vector<Task>& tasks, ports::TimePoint now);

 private:
  ports::Duration time_per_stand_;
  std::optional<Task> doing_;
  ports::TimePoint since_;
};

}  // namespace chiaro::simulator
