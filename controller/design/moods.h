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
/// mood.yaml has title, sentence, tags (a list), attainable (true or false) and, for 3D exemplars,
/// targets: {edge, mean, gradient, variance, contrast, histogram: [256 shares]}, measured on the
/// picture's central square at 256 x 256, in the units of measure::Components.
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
/// The targets of a 3D exemplar from a YAML file: a mood.yaml, or its `targets:` mapping alone.
core::Result<measure::Targets> load_targets(const std::filesystem::path& file);
core::Result<ExampleGoal> goal_of(const Mood& mood, Objective objective);

}  // namespace chiaro::design
