// SPDX-License-Identifier: Apache-2.0
// Derivatives that a task gives, as optimisers see them: by variables scaled to 0..1, fixed ones
// left out. Finite differences of the very same cost are the judge.
#include <cmath>
#include <gtest/gtest.h>

#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

double cost(std::span<const double> x) {
  return std::sin(x[0]) * std::exp(0.3 * x[1]) + x[2] * x[2] * x[0] + std::cosh(0.2 * x[3]);
}
double slopes(std::span<const double> x, std::span<double> out) {
  out[0] = std::cos(x[0]) * std::exp(0.3 * x[1]) + x[2] * x[2];
  out[1] = 0.3 * std::sin(x[0]) * std::exp(0.3 * x[1]);
  out[2] = 2 * x[2] * x[0];
  out[3] = 0.2 * std::sinh(0.2 * x[3]);
  return cost(x);
}

TEST(Gradients, ByUnitVariablesAgreeWithFiniteDifferences) {
  Task task;
  task.bounds = {{-2, 3}, {0.5, 0.5}, {1, 40}, {-0.01, 0.02}};  // the second is fixed
  task.cost = cost;
  task.gradient = slopes;
  const Problem problem(task);
  ASSERT_EQ(problem.dimension(), 3u);
  for (const double at : {0.13, 0.5, 0.77}) {
    const Point unit{at, 1 - at, 0.4 * at};
    Point gradient(3);
    EXPECT_DOUBLE_EQ(problem.cost(unit, gradient), problem.cost(unit));
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-5;
      Point up = unit, down = unit;
      up[k] += kStep, down[k] -= kStep;
      const double measured = (problem.cost(up) - problem.cost(down)) / (2 * kStep);
      EXPECT_NEAR(gradient[k], measured, 1e-6 * (1 + std::abs(measured))) << k << " at " << at;
    }
  }
}

}  // namespace
}  // namespace chiaro::optimise
