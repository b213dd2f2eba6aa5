// SPDX-License-Identifier: Apache-2.0
#include "controller/core/mood_tags.h"

namespace chiaro::core {

const std::vector<MoodTagKind>& mood_tag_kinds() {
  static const std::vector<MoodTagKind> kinds{
      {"pattern",
       {"rembrandt", "loop", "butterfly", "clamshell", "split", "broad", "short", "rim",
        "silhouette", "flat", "from below"}},
      {"tone", {"high key", "mid key", "low key"}},
      {"hardness", {"hard", "soft"}},
      {"colour", {"warm", "neutral", "cool"}}};
  return kinds;
}

std::string& MoodTags::at(std::size_t kind) {
  std::string* const all[] = {&pattern, &tone, &hardness, &colour};
  return *all[kind];
}

const std::string& MoodTags::at(std::size_t kind) const {
  return const_cast<MoodTags*>(this)->at(kind);
}

std::vector<std::string> MoodTags::words() const {
  std::vector<std::string> said;
  for (const std::string& word : {pattern, tone, hardness, colour})
    if (!word.empty()) said.push_back(word);
  return said;
}

}  // namespace chiaro::core
