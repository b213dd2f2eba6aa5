// SPDX-License-Identifier: Apache-2.0
// A lamp without a profile, learned by raising its slots while a person names what they see: what
// was seen becomes a profile file, and the lamp an entry of the studio file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/core/units.h"

namespace chiaro::daemon::interview {

struct LearntSlot {
  std::string sees;          ///< one of panel::kSeen
  std::uint8_t level = 255;  ///< for "keep": what is sent for ever
};
struct LearntLamp {
  std::string profile;  ///< "own/old-panel": its path below the fixtures folder
  std::string maker = "Own", model;
  std::vector<LearntSlot> slots;
  double output_cd = 5000;
  core::Range cct{3200, 5600};  ///< kelvin; equal ends: one colour
};

/// The only mode of a learned profile.
inline constexpr const char* kLearntMode = "learned";

/// "Old panel, left" becomes "own/old-panel-left".
std::string profile_name(const std::string& lamp);
/// The profile file. Problems: no slot gives light, a "fine" with nothing before it, two slots
/// that do the same.
core::Result<std::string> profile_yaml(const LearntLamp& lamp);
/// `yaml` with `entry` (a block indented by two) put first below `fixtures:`, in the indentation
/// that the file uses. A problem when the file has no such line.
core::Result<std::string> with_fixture(const std::string& yaml, const std::string& entry);

}  // namespace chiaro::daemon::interview
