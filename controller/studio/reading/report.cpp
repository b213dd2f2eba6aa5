// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/report.h"

#include <algorithm>

namespace chiaro::studio::reading {

void Report::add(core::Problem problem) {
  // Beyond this nobody reads on, and a hostile file could fill the disk with our answer.
  constexpr std::size_t kMost = 500;
  if (problems_.size() < kMost) {
    problems_.push_back(std::move(problem));
  } else if (problems_.size() == kMost) {
    problems_.push_back(
        {{file_, 0x7fffffff, 0}, "there are more problems than these", "mend these first"});
  }
}

void Report::add(const core::Problems& problems) {
  for (const core::Problem& problem : problems) add(problem);
}

core::Problems Report::sorted() const {
  core::Problems sorted = problems_;
  // Ours first, then other files (profiles), each from top to bottom.
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    const bool a_other = a.where.file != file_, b_other = b.where.file != file_;
    if (a_other != b_other) return b_other;
    if (a_other && a.where.file != b.where.file) return a.where.file < b.where.file;
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
  for (core::Problem& problem : sorted)
    if (problem.where.line == 0x7fffffff) problem.where.line = 0;
  return sorted;
}

}  // namespace chiaro::studio::reading
