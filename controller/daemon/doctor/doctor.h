// SPDX-License-Identifier: Apache-2.0
// What stands between this machine and its lamps: devices, who may use them, real-time limits,
// ports that others hold; each with the command that mends it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/ports/devices.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon::doctor {

struct Finding {
  enum class State { good, note, bad };
  State state = State::good;
  std::string area;     ///< "device", "camera", "real time", "network", "studio", "surface"
  std::string what;     ///< a whole sentence
  std::string command;  ///< that mends it; empty when nothing needs mending
};

/// Who asks: permissions are worked out from the files' modes, so that a test can be anybody.
struct Person {
  unsigned uid = 0;
  std::vector<unsigned> groups;
};
Person whoever_runs_this();

/// `root`: "/" or a folder with proc, sys and dev in it. Nothing is opened but text files there.
std::vector<Finding> examine(const std::filesystem::path& root, const Person& person,
                             ports::Devices& devices, const studio::Studio* studio);

// Its parts, in that order.
void examine_devices(const std::filesystem::path& root, const Person& person,
                     ports::Devices& devices, std::vector<Finding>& findings);
void examine_real_time(const std::filesystem::path& root, std::vector<Finding>& findings);
void examine_network(const std::filesystem::path& root, std::vector<Finding>& findings);
void examine_studio(const std::filesystem::path& root, const studio::Studio& studio,
                    ports::Devices& devices, std::vector<Finding>& findings);

std::string to_text(const std::vector<Finding>& findings);
std::string to_json(const std::vector<Finding>& findings);

}  // namespace chiaro::daemon::doctor
