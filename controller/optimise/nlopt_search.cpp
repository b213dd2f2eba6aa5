// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/nlopt_search.h"

#include <algorithm>
#include <cmath>
#include <nlopt.h>

namespace chiaro::optimise {
namespace {

/// Where nothing feasible has been seen: NLopt compares and subtracts values, so not infinite.
constexpr double kInfeasible = 1e30;
constexpr double kDifference = 1e-4;  // of the range, for gradients that nobody gave

struct Local {
  Run run;
  const Problem* problem;
  nlopt_opt optimiser;
  double worst = -kInfeasible;
};

double tamed(Local& local, double value) {
  if (!std::isfinite(value))
    return local.worst > -kInfeasible ? local.worst + 0.1 * (1 + std::abs(local.worst))
                                      : kInfeasible;
  local.worst = std::max(local.worst, value);
  return value;
}

void by_differences(Local& local, std::span<const double> x, double* gradient) {
  Point moved(x.begin(), x.end());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double low = std::max(0.0, x[i] - kDifference), high = std::min(1.0, x[i] + kDifference);
    moved[i] = high;
    const double up = tamed(local, local.run.evaluate(moved));
    moved[i] = low;
    const double down = tamed(local, local.run.evaluate(moved));
    moved[i] = x[i];
    gradient[i] = (up - down) / (high - low);
  }
}

double evaluate(unsigned n, const double* x, double* gradient, void* data) {
  auto& local = *static_cast<Local*>(data);
  const std::span<const double> at{x, n};
  double value = 0;
  if (gradient != nullptr && local.problem->has_gradient()) {
    value = tamed(local, local.run.evaluate(at, {gradient, n}));
  } else {
    value = tamed(local, local.run.evaluate(at));
    if (gradient != nullptr) by_differences(local, at, gradient);
  }
  if (local.run.over()) nlopt_force_stop(local.optimiser);
  return value;
}

nlopt_algorithm algorithm_of(Search search, unsigned variables) {
  switch (search) {
    case Search::subspace:
      return NLOPT_LN_SBPLX;
    case Search::quadratic:
      return variables > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_SBPLX;  // BOBYQA wants two
    case Search::gradient:
      return NLOPT_LD_LBFGS;
    case Search::crs2:
      return NLOPT_GN_CRS2_LM;
    case Search::mlsl:
      return NLOPT_G_MLSL;
  }
  return NLOPT_LN_SBPLX;
}

}  // namespace

Run nlopt_search(Search search, const Problem& problem, Ledger& ledger, std::uint64_t budget,
                 Point from, double step, std::uint64_t seed) {
  const auto n = static_cast<unsigned>(problem.dimension());
  const auto most = static_cast<int>(std::min<std::uint64_t>(budget, 1u << 30));
  // Its random numbers are the thread's: seeded here they are this search's.
  nlopt_srand(static_cast<unsigned long>(seed));
  Local local{Run(problem, ledger, budget), &problem, nlopt_create(algorithm_of(search, n), n)};
  nlopt_set_min_objective(local.optimiser, evaluate, &local);
  nlopt_set_lower_bounds1(local.optimiser, 0);
  nlopt_set_upper_bounds1(local.optimiser, 1);
  nlopt_set_initial_step1(local.optimiser, step);
  nlopt_set_xtol_abs1(local.optimiser, 1e-6);
  nlopt_set_ftol_rel(local.optimiser, 1e-9);
  nlopt_set_maxeval(local.optimiser, most);
  if (search == Search::mlsl) {
    const nlopt_opt inner = nlopt_create(algorithm_of(Search::quadratic, n), n);
    nlopt_set_xtol_abs1(inner, 1e-4);
    nlopt_set_ftol_rel(inner, 1e-6);
    nlopt_set_initial_step1(inner, step);
    nlopt_set_local_optimizer(local.optimiser, inner);
    nlopt_destroy(inner);
  }
  double value = 0;
  nlopt_optimize(local.optimiser, from.data(), &value);
  nlopt_destroy(local.optimiser);
  return std::move(local.run);
}

}  // namespace chiaro::optimise
