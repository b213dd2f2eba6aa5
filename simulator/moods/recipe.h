// SPDX-License-Identifier: Apache-2.0
// How a mood's picture is drawn, as a person writes it: whose studio, which lamps where, how much
// light of which colour at the face.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "controller/core/mood_tags.h"
#include "controller/core/result.h"
#include "controller/studio/load.h"
#include "controller/studio/studio.h"

namespace chiaro::simulator {

/// About the subject's aim, aimed at it.
using AboutTheSitter = core::Spherical;
struct FreePlace {
  core::Vec3 at, aim_at;
};

struct RecipeLamp {
  std::string name;
  studio::Role role = studio::Role::key;
  std::variant<AboutTheSitter, FreePlace> place;
  studio::Optic optic;
  /// Either of them: illuminance on a surface facing the lamp at what it is aimed at, or stops
  /// below the key's.
  std::optional<double> lux, stops_below_key;
  core::Kelvin cct{5600};
  double tint = 0;
  std::optional<core::Rgb> colour;  ///< instead of cct: linear, any scale
  core::Place where;
};

struct Recipe {
  std::string title, sentence;
  core::MoodTags tags;             ///< all four are said
  std::vector<std::string> words;  ///< what people would search it by
  bool attainable = true;          ///< by the lamps of its studio
  std::filesystem::path studio;
  double sitter_turn = 0;  ///< radians, added to the studio's facing; negative: camera left
  std::optional<core::Kelvin> white_balance;  ///< the camera's; else the studio's
  std::map<std::string, core::Rgb> surfaces;  ///< background planes painted anew
  std::optional<studio::Ambient> ambient;
  std::vector<RecipeLamp> lamps;  ///< the first key is what `below_key` refers to
};

/// Every problem at once, each with its place.
core::Result<Recipe> load_recipe(const std::filesystem::path& file, const studio::Folders& folders);
core::Result<Recipe> parse_recipe(const std::string& yaml, const std::string& file_name,
                                  const studio::Folders& folders);

}  // namespace chiaro::simulator
