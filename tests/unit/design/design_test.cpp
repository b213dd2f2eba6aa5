// SPDX-License-Identifier: Apache-2.0
// Properties of the whole engine on the analytic twin: same answer for any threads, hidden rigs
// found, locks and limits kept, places respected.
#include "controller/design/design.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

using support::AnalyticSource;

constexpr core::Size kSmall{64, 64};

studio::Studio two_lamps() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures.push_back(support::stand_lamp(
      "key", studio::Role::key, {core::radians(-40), core::radians(30), 1.8}, 6000));
  studio.fixtures.push_back(support::stand_lamp("fill", studio::Role::fill,
                                                {core::radians(40), core::radians(10), 2.0}, 3000));
  return studio;
}

Options quick() {
  Options options;
  options.search_size = options.polish_size = kSmall;
  options.full_size = kSmall;
  options.trials = 500;
  options.threads = 1;
  return options;
}

studio::Rig hidden_two(const studio::Studio& studio) {
  studio::Rig rig = studio::placed_rig(studio);
  support::stand(rig, 0, -58, 42, 1.7, 0.55);
  support::stand(rig, 1, 25, 5, 2.0, 0.30);
  return rig;
}

Look designed(const studio::Studio& studio, const Goal& goal, const Options& options) {
  const AnalyticSource twin(studio);
  auto look = design(studio, twin, goal, options);
  EXPECT_TRUE(look.ok()) << core::to_string(look.problems());
  return look ? *look : Look{};
}

// [I-3, I-38]
TEST(Design, FindsTwoHiddenLampsFromTheirPictureAlone) {
  const studio::Studio studio = two_lamps();
  const studio::Rig hidden = hidden_two(studio);
  const auto picture = support::photographed(studio, AnalyticSource(studio), hidden, kSmall);
  Options options = quick();
  options.trials = 1200;
  const Look look = designed(studio, support::like(picture), options);
  for (std::size_t lamp : {0u, 1u}) {
    EXPECT_LT(support::angle_off(look.wanted, hidden, lamp), 3) << studio.fixtures[lamp].name;
    // Light at the face, because level and distance trade.
    const auto light = [&](const studio::Rig& rig) {
      const double d = rig.states[lamp].get(core::Dof::distance);
      return rig.states[lamp].get(core::Dof::intensity) / (d * d);
    };
    EXPECT_NEAR(light(look.wanted) / light(hidden), 1, 0.05) << studio.fixtures[lamp].name;
  }
  EXPECT_EQ(look.judgement.verdict, Verdict::reached);
  EXPECT_LT(look.judgement.residual, 0.02);
}

TEST(Design, GivesTheSameLookForOneTwoAndFourThreads) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  for (const Objective objective : {Objective::wavelet, Objective::perceptual}) {
    Options options = quick();
    options.trials = 150;
    const Look one = designed(studio, support::like(picture, objective), options);
    for (const int threads : {2, 4}) {
      options.threads = threads;
      const Look many = designed(studio, support::like(picture, objective), options);
      EXPECT_EQ(one.wanted, many.wanted);
      EXPECT_EQ(one.placed, many.placed);
      EXPECT_EQ(one.trials, many.trials);
      EXPECT_EQ(one.cost, many.cost);
    }
  }
}

TEST(Design, KeepsLockedLampsExactlyAsTheyAre) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  Options options = quick();
  options.trials = 100;
  options.start = studio::placed_rig(studio);
  options.start->states[1].set(core::Dof::intensity, 0.21);
  options.locked = {"fill"};
  const Look look = designed(studio, support::like(picture), options);
  EXPECT_EQ(look.wanted.states[1], options.start->states[1]);
  EXPECT_EQ(look.placed.states[1], options.start->states[1]);
  EXPECT_NE(look.wanted.states[0], options.start->states[0]);
}

TEST(Design, KeepsLevelsWithinEachLampsLimit) {
  studio::Studio studio = two_lamps();
  studio.fixtures[0].limits.most = 0.4;
  studio.fixtures[1].limits.most = 0.05;
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  for (const Goal& goal : {Goal(support::like(picture)), Goal(IdealGoal{})}) {
    Options options = quick();
    options.trials = 80;
    const Look look = designed(studio, goal, options);
    for (const studio::Rig* rig : {&look.wanted, &look.placed}) {
      EXPECT_LE(rig->states[0].get(core::Dof::intensity), 0.4);
      EXPECT_LE(rig->states[1].get(core::Dof::intensity), 0.05);
    }
  }
}

TEST(Design, NeverPutsALampWhereItMustNotStand) {
  studio::Studio studio = two_lamps();
  // The picture wants both lamps in one place: only one of them may have it.
  studio::Rig together = studio::placed_rig(studio);
  support::stand(together, 0, -30, 30, 1.8, 0.5);
  support::stand(together, 1, -30, 30, 1.8, 0.5);
  const AnalyticSource twin(studio);
  const auto picture = support::photographed(studio, twin, together, kSmall);
  for (const std::string optimiser : {"sbplx", "annealing"}) {
    Options options = quick();
    options.optimiser = optimiser;
    const Look look = designed(studio, support::like(picture), options);
    for (std::size_t lamp : {0u, 1u})
      EXPECT_EQ(twin.at(kSmall).infeasible(look.wanted, lamp), "") << optimiser;
  }
}

TEST(Design, LeavesStandsAloneWhenToldTo) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  Options options = quick();
  options.move_stands = false;
  const Look look = designed(studio, support::like(picture), options);
  EXPECT_EQ(look.wanted, look.placed);
  EXPECT_TRUE(look.instructions.empty());
}

TEST(Design, SolvesThePlacedRigTooAndSaysWhichStandsToMove) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  const Look look = designed(studio, support::like(picture), quick());
  EXPECT_DOUBLE_EQ(look.placed.states[0].get(core::Dof::azimuth), core::radians(-40));
  EXPECT_GT(look.placed.states[0].get(core::Dof::intensity), 0.05);
  EXPECT_GE(look.placed_judgement.residual, look.judgement.residual);
  ASSERT_FALSE(look.instructions.empty());
  EXPECT_EQ(look.instructions.front().rfind("move key to ", 0), 0u) << look.instructions.front();
}

TEST(Design, RecordsATimeStop) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  double now = 0;
  Options options = quick();
  options.trials = 0;
  options.budget_s = 0.5;
  options.seconds = [&now] { return now += 0.01; };
  const Look look = designed(studio, support::like(picture), options);
  EXPECT_TRUE(look.stopped_by_time);
  EXPECT_GT(look.trials, 10u);
  EXPECT_LT(look.trials, 100u);
}

TEST(Design, CountsTrialsThroughItsStages) {
  const studio::Studio studio = two_lamps();
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  Options options = quick();
  std::uint64_t last = 0;
  std::vector<std::string> stages;
  options.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.trial, last);
    last = progress.trial;
    if (stages.empty() || stages.back() != progress.stage) stages.push_back(progress.stage);
  };
  const Look look = designed(studio, support::like(picture), options);
  EXPECT_EQ(stages, (std::vector<std::string>{"search", "polish"}));
  EXPECT_GE(look.trials, 500u);
}

TEST(Design, ListsEveryWrongNameAtOnce) {
  const studio::Studio studio = two_lamps();
  Options options = quick();
  options.locked = {"fil", "kay"};
  options.optimiser = "sbplxx";
  const auto look = design(studio, AnalyticSource(studio), IdealGoal{}, options);
  ASSERT_FALSE(look.ok());
  ASSERT_EQ(look.problems().size(), 3u);
  EXPECT_NE(look.problems()[0].remedy.find("fill"), std::string::npos);
  EXPECT_NE(look.problems()[2].remedy.find("sbplx"), std::string::npos);
}

TEST(Design, RefusesAnEmptyReferencePicture) {
  const studio::Studio studio = two_lamps();
  EXPECT_FALSE(design(studio, AnalyticSource(studio), ExampleGoal{}, quick()).ok());
}

TEST(Design, ReferencePathSearchesLevelsTooAndKeepsThemWithinLimits) {
  studio::Studio studio = two_lamps();
  studio.fixtures[0].limits.most = 0.7;
  const auto picture =
      support::photographed(studio, AnalyticSource(studio), hidden_two(studio), kSmall);
  Options options = quick();
  options.reference = true;
  options.optimiser = "annealing";
  options.trials = 300;
  const Look look = designed(studio, support::like(picture), options);
  EXPECT_LE(look.trials, 300u);
  EXPECT_GT(look.wanted.states[0].get(core::Dof::intensity), 0);
  EXPECT_LE(look.wanted.states[0].get(core::Dof::intensity), 0.7);
  const Look fast = designed(studio, support::like(picture), quick());
  EXPECT_LT(fast.cost, look.cost);
}

}  // namespace
}  // namespace chiaro::design
