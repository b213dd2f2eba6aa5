// SPDX-License-Identifier: Apache-2.0
// What a photographer calls a light: its pattern on the face, the picture's tone, how hard its
// shadows are and its colour. Recipes and moods are tagged with these words and no others.
#pragma once

#include <string>
#include <vector>

namespace chiaro::core {

/// One question about a light and the answers that exist.
struct MoodTagKind {
  std::string name;
  std::vector<std::string> words;
};
/// pattern, tone, hardness, colour; in this order everywhere.
const std::vector<MoodTagKind>& mood_tag_kinds();

/// Empty where nothing was said.
struct MoodTags {
  std::string pattern, tone, hardness, colour;

  std::string& at(std::size_t kind);
  const std::string& at(std::size_t kind) const;
  /// The words said, in order.
  std::vector<std::string> words() const;
  friend bool operator==(const MoodTags&, const MoodTags&) = default;
};

}  // namespace chiaro::core
