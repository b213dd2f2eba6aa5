// SPDX-License-Identifier: Apache-2.0
// The sources say themselves which item of the thesis they implement, by tags such as [I-14] in
// comments, and so do the tests. Here the tags are collected: at build time, for the program, and
// in tests, for the rule that no item is without owner and test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace chiaro::daemon::study {

inline constexpr int kThesisItems = 41;

/// One mention of an item. `test` is Suite.Name in a test file, else empty.
struct Tag {
  int item = 0;
  std::string file, test;
};

/// The numbers in one line's tags: "[I-9, I-23]" gives 9 and 23, "[I-14..I-16]" 14, 15 and 16.
std::vector<int> items_in(const std::string& line);
/// Of one file's text. In a test file a tag belongs to the test whose body it stands in, or, before
/// one, to the next.
std::vector<Tag> tags_in(const std::string& file, const std::string& text);
/// Of controller, simulator, drivers, calibration and tests below `root`; sorted, each once.
std::vector<Tag> tags_below(const std::filesystem::path& root);

}  // namespace chiaro::daemon::study
