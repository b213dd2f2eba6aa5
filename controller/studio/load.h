// SPDX-License-Identifier: Apache-2.0
// From a studio file to a Studio, or to every problem in it at once.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/studio/studio.h"

namespace chiaro::studio {

/// Where shipped profiles, subjects and moods are found: the installed or source `config` folder.
struct Folders {
  std::filesystem::path config;
  std::filesystem::path own{};  ///< the user's own profiles: `fixtures` beside the studio file
  std::filesystem::path fixtures() const { return config / "fixtures"; }
  std::filesystem::path subjects() const { return config / "subjects"; }
  std::filesystem::path moods() const { return config / "moods"; }
  std::filesystem::path studios() const { return config / "studios"; }
};

struct Loaded {
  Studio studio;
  core::Problems warnings;
};
/// Reads and checks the whole file: grammar, units, ranges, files that must exist, profiles, modes,
/// address overlaps and footprints, outputs for every used universe. Never throws on bad input.
core::Result<Loaded> load_studio(const std::filesystem::path& file, const Folders& folders);
/// The same from text, for tests, fuzzing and the panel; relative paths are taken from `base`.
core::Result<Loaded> parse_studio(const std::string& yaml, const std::filesystem::path& base,
                                  const Folders& folders);

core::Result<Profile> load_profile(const std::string& name, const Folders& folders);
std::vector<std::string> profile_names(const Folders& folders);

}  // namespace chiaro::studio
