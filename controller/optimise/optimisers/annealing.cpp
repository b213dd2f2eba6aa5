// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/annealing.h"

#include <algorithm>
#include <cmath>

#include "controller/core/random.h"
#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

constexpr double kCooling = 0.9;
constexpr double kEndOverStart = 1e-4;  // of the temperature
constexpr double kWidestStep = 0.25, kNarrowestStep = 0.002;
constexpr std::uint64_t kProbes = 20;

/// Folds a coordinate back into 0..1 as a ray between two mirrors.
double mirrored(double x) {
  x = std::fmod(std::abs(x), 2.0);
  return x > 1 ? 2 - x : x;
}

class Annealing final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    Run run(problem, ledger, task.trials);
    core::Random random(task.seed, 1);
    State now = begin(problem, run, random);
    if (problem.dimension() > 0) {
      const double hot = starting_temperature(now, run, random);
      const double steps = std::log(kEndOverStart) / std::log(kCooling);
      const std::uint64_t left = task.trials - std::min(task.trials, run.used());
      const auto chain =
          static_cast<std::uint64_t>(std::max(1.0, std::ceil(static_cast<double>(left) / steps)));
      for (double heat = 1; !run.over(); heat *= kCooling)
        for (std::uint64_t k = 0; k < chain && !run.over(); ++k) move(now, hot, heat, run, random);
    }
    record.absorb(run, true);
    return record.finish();
  }

 private:
  struct State {
    Point at;
    double value;
  };

  static State begin(const Problem& problem, Run& run, core::Random& random) {
    State best{Point(problem.dimension()), std::numeric_limits<double>::infinity()};
    for (const Point& start : problem.task().starts) {
      const Point unit = problem.unit_of(start);
      const double value = run.evaluate(unit);
      if (value < best.value) best = {unit, value};
    }
    // A random start as in the thesis; drawn again while it is infeasible.
    while (!std::isfinite(best.value) && !run.over()) {
      for (double& x : best.at) x = random.uniform();
      best.value = run.evaluate(best.at);
      if (best.at.empty()) break;
    }
    return best;
  }

  static Point neighbour(const Point& at, double heat, core::Random& random) {
    Point to = at;
    const auto k = random.below(static_cast<std::uint32_t>(at.size()));
    const double width = std::max(kNarrowestStep, kWidestStep * std::sqrt(heat));
    to[k] = mirrored(to[k] + width * random.normal());
    return to;
  }

  /// exp(-rise / T) = 1/2 for the mean rise.
  static double starting_temperature(const State& now, Run& run, core::Random& random) {
    double rise = 0;
    int rises = 0;
    for (std::uint64_t k = 0; k < kProbes && !run.over(); ++k) {
      const double value = run.evaluate(neighbour(now.at, 1, random));
      if (!std::isfinite(value) || value <= now.value) continue;
      rise += value - now.value;
      ++rises;
    }
    return rises > 0 ? rise / rises / std::log(2.0) : 1e-3 * (1 + std::abs(now.value));
  }

  static void move(State& now, double hot, double heat, Run& run, core::Random& random) {
    Point to = neighbour(now.at, heat, random);
    const double value = run.evaluate(to);
    if (!std::isfinite(value)) return;
    if (value <= now.value || random.uniform() < std::exp((now.value - value) / (hot * heat)))
      now = {std::move(to), value};
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_annealing() { return std::make_unique<Annealing>(); }

}  // namespace chiaro::optimise
