// SPDX-License-Identifier: Apache-2.0
#include "controller/core/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace chiaro::core {
namespace {

TEST(WilsonInterval, AgreesWithPublishedValues) {
  // Newcombe 1998, table I: 81 of 263 -> 0.2553, 0.3662; 15 of 148 -> 0.0624, 0.1605.
  EXPECT_NEAR(wilson_interval(81, 263).least, 0.2553, 5e-5);
  EXPECT_NEAR(wilson_interval(81, 263).most, 0.3662, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).least, 0.0624, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).most, 0.1605, 5e-5);
}

TEST(WilsonInterval, IsSureOfNothingAtTheEnds) {
  // Newcombe: 0 of 20 -> 0, 0.1611; 29 of 29 -> 0.8830, 1.
  EXPECT_EQ(wilson_interval(0, 20).least, 0);
  EXPECT_NEAR(wilson_interval(0, 20).most, 0.1611, 5e-5);
  EXPECT_NEAR(wilson_interval(29, 29).least, 0.8830, 5e-5);
  EXPECT_EQ(wilson_interval(29, 29).most, 1);
  EXPECT_EQ(wilson_interval(0, 0).least, 0);
  EXPECT_EQ(wilson_interval(0, 0).most, 1);
}

TEST(SignTest, CountsBothTails) {
  // 9 : 1 -> 2 (1 + 10) / 2^10 = 0.021484; 5 : 0 -> 2 / 32; an even split and no pair at all: 1.
  EXPECT_NEAR(sign_test(9, 1), 22.0 / 1024, 1e-12);
  EXPECT_NEAR(sign_test(1, 9), 22.0 / 1024, 1e-12);
  EXPECT_NEAR(sign_test(5, 0), 2.0 / 32, 1e-12);
  EXPECT_EQ(sign_test(3, 3), 1);
  EXPECT_EQ(sign_test(0, 0), 1);
}

TEST(PairedDifference, AgreesWithStudentsTables) {
  // Differences 1 2 3 4: mean 2.5, deviation 1.290994, error 0.645497; t with 3 degrees at 95 % is
  // 3.182446: 2.5 +- 2.054260. t = 3.872983 has p = 0.030466.
  const PairedDifference d = paired_difference(std::vector<double>{1, 2, 3, 4});
  EXPECT_NEAR(d.mean, 2.5, 1e-12);
  EXPECT_NEAR(d.interval.least, 0.445740, 1e-5);
  EXPECT_NEAR(d.interval.most, 4.554260, 1e-5);
  EXPECT_NEAR(d.p, 0.030466, 1e-5);
}

TEST(PairedDifference, SaysLittleOfLittle) {
  EXPECT_EQ(paired_difference({}).p, 1);
  EXPECT_EQ(paired_difference(std::vector<double>{3}).interval.least, 3);
  EXPECT_EQ(paired_difference(std::vector<double>{0, 0, 0}).p, 1);
}

TEST(Quantile, InterpolatesAndKeepsNever) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4, 5}, 0.25), 2);
  EXPECT_EQ(quantile({1, kNever, kNever}, 0.75), kNever);
  EXPECT_EQ(median({}), 0);
}

}  // namespace
}  // namespace chiaro::core
