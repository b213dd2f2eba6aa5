// SPDX-License-Identifier: Apache-2.0
// What every line of optimisers.def promises: bounds, budget, seed, threads, stop, infeasibility.
#include <atomic>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sphere(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = x[i] - 0.3 - 0.1 * static_cast<double>(i);
    sum += off * off;
  }
  return sum;
}
double rosenbrock(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
  return sum;
}
/// Rastrigin's, its least of 0 at 0.7: about 100 local optima in two variables of -5..5.
double egg_box(std::span<const double> x) {
  double sum = 0;
  for (const double v : x) {
    const double off = v - 0.7;
    sum += off * off + 10 * (1 - std::cos(2 * 3.14159265358979 * off));
  }
  return sum;
}

Task task_of(Cost cost, std::size_t n, double least, double most, std::uint64_t trials) {
  Task task;
  task.cost = std::move(cost);
  task.bounds.assign(n, {least, most});
  task.trials = trials;
  task.seed = 7;
  return task;
}

void expect_equal(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.trials, b.trials);
  EXPECT_EQ(a.basins, b.basins);
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t i = 0; i < a.trace.size(); ++i) {
    EXPECT_EQ(a.trace[i].trial, b.trace[i].trial);
    EXPECT_EQ(a.trace[i].value, b.trace[i].value);
  }
}

class EveryOptimiser : public testing::TestWithParam<OptimiserEntry> {
 protected:
  Outcome run(const Task& task) const { return GetParam().make()->minimise(task); }
};

TEST_P(EveryOptimiser, KeepsBoundsAndBudget) {
  for (const std::uint64_t trials : {1u, 2u, 7u, 50u, 333u}) {
    std::atomic<std::uint64_t> calls{0};
    std::atomic<bool> outside{false};
    Task task = task_of(
        [&](std::span<const double> x) {
          ++calls;
          if (x.size() != 3) outside = true;
          for (const double v : x)
            if (!(v >= -2 && v <= 5)) outside = true;
          return -x[0] - x[1] + x[2];  // pulls into a corner
        },
        3, -2, 5, trials);
    task.threads = 2;
    const Outcome outcome = run(task);
    EXPECT_LE(calls, trials);
    EXPECT_EQ(outcome.trials, calls);
    EXPECT_GE(calls + 1, std::min<std::uint64_t>(trials, 2));
    EXPECT_FALSE(outside);
    EXPECT_EQ(outcome.best.size(), 3u);
    EXPECT_FALSE(outcome.stopped);
  }
}

TEST_P(EveryOptimiser, SameSeedSameAnswerForAnyNumberOfThreads) {
  Task task = task_of(egg_box, 4, -5, 5, 700);
  const Outcome alone = run(task);
  expect_equal(alone, run(task));
  task.threads = 4;
  expect_equal(alone, run(task));
  task.seed = 8;
  EXPECT_NE(run(task).best, alone.best);
}

// [I-25..I-27]
TEST_P(EveryOptimiser, FindsTheBottomOfABowl) {
  const Outcome outcome = run(task_of(sphere, 3, -1, 2, 3000));
  EXPECT_LT(outcome.value, GetParam().name == "genetic" ? 1e-2 : 1e-4);
  EXPECT_EQ(outcome.value, sphere(outcome.best));
}

TEST_P(EveryOptimiser, GetsFarDownACurvedValley) {
  EXPECT_LT(run(task_of(rosenbrock, 3, -2, 2, 6000)).value, 1);
}

TEST_P(EveryOptimiser, LeavesLocalOptimaOrStartsAgain) {
  EXPECT_LT(run(task_of(egg_box, 2, -5, 5, 6000)).value, 1.2);
}

TEST_P(EveryOptimiser, WalksRoundInfeasibleRegions) {
  // Three quarters of the box are forbidden; the least of what is left lies on their edge.
  const Cost cost = [](std::span<const double> x) {
    return x[0] < 0.5 || x[1] < 0.5 ? kInfinity : sphere(x);
  };
  const Outcome outcome = run(task_of(cost, 2, 0, 1, 2000));
  EXPECT_NEAR(outcome.value, 0.04 + 0.01, 0.01);
  EXPECT_GE(outcome.best[0], 0.5);
  EXPECT_GE(outcome.best[1], 0.5);
}

TEST_P(EveryOptimiser, AnswersEvenWhenNothingIsFeasibleOrEverythingIsNotANumber) {
  for (const double value : {kInfinity, std::nan("")}) {
    const Outcome outcome =
        run(task_of([=](std::span<const double>) { return value; }, 2, 0, 1, 100));
    EXPECT_EQ(outcome.value, kInfinity);
    EXPECT_EQ(outcome.best.size(), 2u);
    EXPECT_LE(outcome.trials, 100u);
    EXPECT_TRUE(outcome.basins.empty());
  }
}

TEST_P(EveryOptimiser, LeavesFixedVariablesAlone) {
  Task task = task_of(sphere, 3, -1, 2, 2000);
  task.bounds[1] = {1.25, 1.25};
  const Outcome outcome = run(task);
  EXPECT_EQ(outcome.best[1], 1.25);
  EXPECT_NEAR(outcome.value, 0.85 * 0.85, 0.01);
  for (auto& b : task.bounds) b = {0.5, 0.5};
  const Outcome fixed = run(task);
  EXPECT_EQ(fixed.best, (Point{0.5, 0.5, 0.5}));
  EXPECT_EQ(fixed.value, sphere(fixed.best));
}

TEST_P(EveryOptimiser, IsNeverWorseThanItsStarts) {
  Task task = task_of(egg_box, 3, -5, 5, 40);
  task.starts = {{-4, -4, -4}, {0.71, 0.7, 0.69}};
  EXPECT_LE(run(task).value, egg_box(task.starts[1]) + 1e-9);
}

TEST_P(EveryOptimiser, StopsWhenToldAndKeepsTheBest) {
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  Task task = task_of(
      [&](std::span<const double> x) {
        if (++calls == 100) stop = true;
        return sphere(x);
      },
      3, -1, 2, 1000000);
  task.stop = &stop;
  const Outcome outcome = run(task);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_LT(outcome.trials, 200u);
  EXPECT_TRUE(std::isfinite(outcome.value));
}

TEST_P(EveryOptimiser, ReportsProgressOncePerTrialWithTheBestSoFar) {
  std::vector<std::pair<std::uint64_t, double>> seen;
  Task task = task_of(sphere, 2, -1, 2, 150);
  task.threads = 3;
  task.progress = [&](std::uint64_t trial, double best) { seen.emplace_back(trial, best); };
  const Outcome outcome = run(task);
  ASSERT_EQ(seen.size(), outcome.trials);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].first, i + 1);
    if (i > 0) {
      EXPECT_LE(seen[i].second, seen[i - 1].second);
    }
  }
  EXPECT_EQ(seen.back().second, outcome.value);
}

TEST_P(EveryOptimiser, TraceFallsAndEndsAtTheBest) {
  const Outcome outcome = run(task_of(egg_box, 3, -5, 5, 500));
  ASSERT_FALSE(outcome.trace.empty());
  for (std::size_t i = 1; i < outcome.trace.size(); ++i) {
    EXPECT_GT(outcome.trace[i].trial, outcome.trace[i - 1].trial);
    EXPECT_LT(outcome.trace[i].value, outcome.trace[i - 1].value);
  }
  EXPECT_LE(outcome.trace.back().trial, outcome.trials);
  EXPECT_EQ(outcome.trace.back().value, outcome.value);
}

TEST_P(EveryOptimiser, BasinsAreApartBestFirst) {
  const Outcome outcome = run(task_of(egg_box, 2, -5, 5, 1500));
  ASSERT_FALSE(outcome.basins.empty());
  EXPECT_LE(outcome.basins.size(), 8u);
  EXPECT_EQ(outcome.basins.front().first, outcome.best);
  for (std::size_t i = 0; i < outcome.basins.size(); ++i) {
    EXPECT_EQ(outcome.basins[i].second, egg_box(outcome.basins[i].first));
    if (i > 0) {
      EXPECT_GE(outcome.basins[i].second, outcome.basins[i - 1].second);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Def, EveryOptimiser,
                         testing::ValuesIn(optimisers().begin(), optimisers().end()),
                         [](const auto& entry) { return std::string(entry.param.name); });

/// Tells the difference between a known gradient and one taken by differences.
TEST(Optimisers, LbfgsUsesTheGradientItIsGiven) {
  Task task = task_of(rosenbrock, 3, -2, 2, 400);
  std::atomic<int> asked{0};
  task.gradient = [&](std::span<const double> x, std::span<double> gradient) {
    ++asked;
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double off = x[i + 1] - x[i] * x[i];
      gradient[i] += -400 * x[i] * off - 2 * (1 - x[i]);
      gradient[i + 1] += 200 * off;
    }
    return rosenbrock(x);
  };
  const Outcome outcome = make_optimiser("lbfgs")->minimise(task);
  EXPECT_GT(asked, 100);
  EXPECT_LT(outcome.value, 1e-8);
  EXPECT_LE(outcome.trials, 400u);
}

TEST(Optimisers, ListAndFolderAgree) {
  std::set<std::string> files, listed;
  for (const auto& entry :
       std::filesystem::directory_iterator(CHIARO_SOURCE "/controller/optimise/optimisers"))
    files.insert(entry.path().stem().string());
  for (const OptimiserEntry& entry : optimisers()) listed.insert(std::string(entry.name));
  EXPECT_EQ(files, listed);
}

TEST(Optimisers, AnUnknownNameHasNone) { EXPECT_EQ(make_optimiser("magic"), nullptr); }

}  // namespace
}  // namespace chiaro::optimise
