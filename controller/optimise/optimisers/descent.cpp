// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/descent.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "controller/core/random.h"
#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

constexpr double kFirstStep = 1.0 / 8, kLastStep = 1.0 / 1000;

/// From one start down to where no step gains.
void descend(Run& run, Point at, double value) {
  for (double step = kFirstStep; step >= kLastStep && !run.over();) {
    Point best = at;
    double least = value;
    for (std::size_t k = 0; k < at.size(); ++k) {
      for (const double way : {-step, step}) {
        Point to = at;
        to[k] = std::min(1.0, std::max(0.0, to[k] + way));
        if (to[k] == at[k]) continue;
        const double there = run.evaluate(to);
        if (there < least) least = there, best = to;
      }
    }
    if (least < value)
      at = best, value = least;
    else
      step /= 2;
  }
}

class Descent final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    core::Random random(task.seed, 2);
    std::vector<Point> starts;
    for (const Point& start : task.starts) starts.push_back(problem.unit_of(start));
    const std::vector<double> values = evaluate_all(problem, ledger, record, starts);
    std::vector<std::size_t> order(starts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
    for (std::size_t k = 0; record.left() > 0 && !record.stopped(); ++k) {
      Run run(problem, ledger, record.left());
      if (k < order.size()) {
        descend(run, starts[order[k]], values[order[k]]);
      } else {
        Point start(problem.dimension());
        for (double& x : start) x = random.uniform();
        const double value = run.evaluate(start);
        descend(run, std::move(start), value);
      }
      record.absorb(run, true);
      if (problem.dimension() == 0) break;
    }
    return record.finish();
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_descent() { return std::make_unique<Descent>(); }

}  // namespace chiaro::optimise
