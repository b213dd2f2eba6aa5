// SPDX-License-Identifier: Apache-2.0
// What the build knew and the program tells: which sources it was made from, and their tags.
// Written anew by study_facts_main.cpp with every build.
#pragma once

#include <span>

namespace chiaro::daemon::study {

struct TagFact {
  int item;
  const char *file, *test;
};
std::span<const TagFact> tag_facts();

}  // namespace chiaro::daemon::study
