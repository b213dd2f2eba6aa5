// SPDX-License-Identifier: Apache-2.0
// No item of the thesis is without an owner in the sources and a test that names it.
#include <array>
#include <gtest/gtest.h>

#include "controller/daemon/study/tags.h"

namespace chiaro::daemon::study {
namespace {

TEST(ThesisChecklist, EveryItemHasAnOwnerAndATest) {
  std::array<bool, kThesisItems + 1> owner{}, test{};
  for (const Tag& tag : tags_below(CHIARO_SOURCE)) {
    const auto item = static_cast<std::size_t>(tag.item);
    if (tag.file.rfind("tests/", 0) != 0) owner[item] = true;
    if (!tag.test.empty()) test[item] = true;
  }
  for (std::size_t item = 1; item <= kThesisItems; ++item) {
    EXPECT_TRUE(owner[item]) << "I-" << item << " stands in no source";
    EXPECT_TRUE(test[item]) << "I-" << item << " is named by no test";
  }
}

}  // namespace
}  // namespace chiaro::daemon::study
