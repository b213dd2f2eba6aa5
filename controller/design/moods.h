// SPDX-License-Identifier: Apache-2.0
// The shipped and the user's moods: pictures whose lighting is wanted, with words for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/design/design.h"

namespace chiaro::design {

/// A folder in config/moods: `mood.yaml`, `recipe.yaml` (how the picture was drawn), `picture.png`.
struct Mood {
  std::string name;      ///< the folder's name: "rembrandt"
  std::string title;     ///< "Rembrandt"
  std::string sentence;  ///< one sentence for people
  std::vector<std::string> tags;
  std::filesystem::path picture;
  std::optional<measure::Targets> targets;  ///< of the 3D exemplar, when drawn by us
  bool attainable = true;                   ///< on the shipped studio
};
/// In name order. A broken mood is a problem with its place, the others still load.
struct Moods {
  std::vector<Mood> moods;
  core::Problems problems;
};
Moods load_moods(const std::filesystem::path& folder);
core::Result<ExampleGoal> goal_of(const Mood& mood, Objective objective);

}  // namespace chiaro::design
