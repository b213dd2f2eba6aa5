// SPDX-License-Identifier: Apache-2.0
// The shipped and the user's moods: pictures whose lighting is wanted, with words for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/mood_tags.h"
#include "controller/core/result.h"
#include "controller/design/design.h"

namespace chiaro::design {

/// A folder in config/moods: `mood.yaml`, `recipe.yaml` (how the picture was drawn), `picture.png`.
/// mood.yaml has title, sentence, tags ({pattern, tone, hardness, colour}: core::MoodTags), words
/// (a list), attainable (true or false), sitter_turn (`-35 deg`), white_balance (`5600 K`),
/// exposure
/// (`-0.33 stops`) and, for 3D exemplars, targets: {edge, mean, gradient, variance, contrast,
/// histogram: [256 shares]}, measured on the picture's central square at 256 x 256, in the units of
/// measure::Components. All but the picture may be left out.
struct Mood {
  std::string name;      ///< the folder's name: "rembrandt"
  std::string title;     ///< "Rembrandt"
  std::string sentence;  ///< one sentence for people
  core::MoodTags tags;
  std::vector<std::string> words;  ///< what people would search it by, beside its tags
  /// How the sitter is turned, radians: 0 = towards the camera, negative = to camera left.
  double sitter_turn = 0;
  std::optional<core::Kelvin> white_balance;  ///< the camera's when the picture was taken
  /// Illuminance of the front of the face, in stops from the camera's exposure (grey_card).
  std::optional<double> exposure_stops;
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
/// "35° to camera left"; empty when the sitter faces the camera (within a degree).
std::string turn_in_words(double sitter_turn);

}  // namespace chiaro::design
