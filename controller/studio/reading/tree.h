// SPDX-License-Identifier: Apache-2.0
// A YAML text as plain nodes that remember where they stand. Hostile input ends here: what comes
// out is small, shallow text whose keys are unique.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::studio::reading {

struct Tree {
  enum class Kind { nothing, scalar, sequence, mapping };
  struct Key {
    std::string text;
    int line = 0, column = 0;
  };
  Kind kind = Kind::nothing;
  std::string text;          ///< scalar
  bool quoted = false;       ///< scalar in quotes: never a number
  std::string label;         ///< the key this is the value of, or whose list holds it
  int line = 0, column = 0;  ///< 1-based
  std::vector<Key> keys;     ///< mapping: keys[i] names items[i]
  std::vector<Tree> items;   ///< sequence or mapping
};

/// No studio or profile file is larger, deeper or has more nodes (aliases counted as copied).
inline constexpr std::size_t kMostBytes = 2u << 20;
inline constexpr std::size_t kMostNodes = 100'000;
inline constexpr std::size_t kMostDepth = 40;

/// A tree and what is wrong with it that need not end the reading: keys that stand twice.
struct Document {
  Tree root;
  core::Problems problems;
};
/// The one document in `yaml`; `file` stands in the places of problems. Cycles, bytes that are not
/// UTF-8 text and anything beyond the bounds above are refused.
core::Result<Document> parse_tree(const std::string& yaml, const std::string& file);

}  // namespace chiaro::studio::reading
