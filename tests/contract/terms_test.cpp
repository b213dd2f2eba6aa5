// SPDX-License-Identifier: Apache-2.0
// What every line of terms.def promises.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

#include "controller/core/random.h"
#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {
namespace {

Components any_components(std::uint64_t seed) {
  core::Random random(seed);
  Components c;
  c.edge = random.uniform();
  c.mean = random.uniform(0, 255);
  c.gradient = random.uniform(0, 60);
  c.variance = random.uniform(0, 127.5);
  c.contrast = random.uniform();
  double sum = 0;
  for (double& h : c.histogram) sum += h = random.uniform();
  for (double& h : c.histogram) h /= sum;
  return c;
}

class EveryTerm : public testing::TestWithParam<Term> {};

TEST_P(EveryTerm, CostsNothingWhenMet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Components c = any_components(seed);
    EXPECT_NEAR(GetParam().example(c, targets_of(c, true), {}).value(), 0, 1e-12);
  }
}

TEST_P(EveryTerm, CostsBetweenNothingAndOneTowardsAnyExample) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double cost =
        GetParam()
            .example(any_components(seed), targets_of(any_components(seed + 1000), true), {})
            .value();
    EXPECT_GT(cost, 0);
    EXPECT_LE(cost, 1 + 1e-12);
  }
}

TEST_P(EveryTerm, SaysNothingWithoutATarget) {
  EXPECT_FALSE(GetParam().example(any_components(1), {}, {}).has_value());
}

TEST_P(EveryTerm, IdealCostIsFiniteAndNotNegativeForBlackAndForAnything) {
  for (const Components& c : {Components{}, any_components(5)}) {
    const double cost = GetParam().ideal(c, {}, {});
    EXPECT_GE(cost, 0);
    EXPECT_LE(cost, 4);
  }
}

TEST_P(EveryTerm, SurvivesTargetsOfZero) {
  const Targets black = targets_of(Components{}, true);
  EXPECT_TRUE(std::isfinite(GetParam().example(any_components(3), black, {}).value()));
  EXPECT_TRUE(std::isfinite(GetParam().ideal(any_components(3), {0, 0, 0, 0}, {})));
}

// [I-11, I-12]
TEST_P(EveryTerm, ItsWeightAloneDecidesItsShare) {
  const Components now = any_components(1);
  const Targets goal = targets_of(any_components(2), true);
  TermWeights none{0, 0, 0, 0, 0, 0};
  EXPECT_EQ(perceptual_cost(now, goal, none), 0);
  none.*GetParam().weight = 0.5;
  EXPECT_DOUBLE_EQ(perceptual_cost(now, goal, none),
                   0.5 * GetParam().example(now, goal, none).value());
  EXPECT_DOUBLE_EQ(ideal_cost(now, {}, none), 0.5 * GetParam().ideal(now, {}, none));
}

INSTANTIATE_TEST_SUITE_P(Def, EveryTerm, testing::ValuesIn(all().begin(), all().end()),
                         [](const auto& term) { return std::string(term.param.name); });

TEST(Terms, ListAndFolderAgree) {
  std::set<std::string> files, listed{"term"};
  for (const auto& entry :
       std::filesystem::directory_iterator(CHIARO_SOURCE "/controller/measure/terms"))
    files.insert(entry.path().stem().string());
  for (const Term& term : all()) listed.insert(std::string(term.name));
  EXPECT_EQ(files, listed);
}

}  // namespace
}  // namespace chiaro::measure::terms
