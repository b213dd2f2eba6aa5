// SPDX-License-Identifier: Apache-2.0
#include "controller/core/result.h"

#include <gtest/gtest.h>

namespace chiaro::core {
namespace {

TEST(Result, HoldsAValue) {
  Result<int> result(42);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(*result, 42);
  EXPECT_TRUE(result.problems().empty());
}

TEST(Result, HoldsProblemsAndRefusesToBeReadAsAValue) {
  const Result<int> result(Problem{{"a.yaml", 3, 7}, "wrong", "mend it"});
  EXPECT_FALSE(result.ok());
  ASSERT_EQ(result.problems().size(), 1u);
  EXPECT_THROW(result.value(), std::logic_error);
}

TEST(Result, MovesItsValueOut) {
  Result<std::string> result(std::string("long enough to live on the heap, surely"));
  const std::string taken = std::move(result).value();
  EXPECT_EQ(taken, "long enough to live on the heap, surely");
}

TEST(Problem, IsPrintedAsPlaceWhatAndRemedy) {
  EXPECT_EQ(to_string(Problem{{"a.yaml", 3, 7}, "wrong", "mend it"}),
            "a.yaml:3:7: wrong (mend it)");
  EXPECT_EQ(to_string(Problem{{"a.yaml", 3, 0}, "wrong", ""}), "a.yaml:3: wrong");
  EXPECT_EQ(to_string(Problem{{"a.yaml", 0, 0}, "wrong", ""}), "a.yaml: wrong");
  EXPECT_EQ(to_string(Problem{{}, "wrong", ""}), "wrong");
  EXPECT_EQ(to_string(Problem{{"a", 1, 1}, "odd", "", true}), "a:1:1: warning: odd");
}

TEST(Problem, WarningsAloneRefuseNothing) {
  EXPECT_FALSE(any_error({}));
  EXPECT_FALSE(any_error({{{}, "odd", "", true}}));
  EXPECT_TRUE(any_error({{{}, "odd", "", true}, {{}, "wrong", "", false}}));
}

TEST(NearestName, FindsATypingMistake) {
  const std::vector<std::string> known{"azimuth", "elevation", "distance"};
  EXPECT_EQ(nearest_name("azimut", known), "azimuth");
  EXPECT_EQ(nearest_name("elevaton", known), "elevation");
  EXPECT_EQ(nearest_name("distnace", known), "distance");
}

TEST(NearestName, StaysSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("colour", {"azimuth", "elevation"}), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
  // Three letters changed in four is another word.
  EXPECT_EQ(nearest_name("abcd", {"axyz"}), "");
}

TEST(NearestName, TakesTheFirstOfEqualsAndAnExactOneBeforeAll) {
  EXPECT_EQ(nearest_name("cat", {"bat", "hat"}), "bat");
  EXPECT_EQ(nearest_name("hat", {"bat", "hat"}), "hat");
}

}  // namespace
}  // namespace chiaro::core
