// SPDX-License-Identifier: Apache-2.0
// NLopt's searches behind our promises: the unit cube, the budget, the stop flag, infeasible
// points.
#pragma once

#include "controller/optimise/search.h"

namespace chiaro::optimise {

/// subspace: Rowan's SBPLX. quadratic: Powell's BOBYQA; with one variable SBPLX. gradient: Luksan's
/// bounded L-BFGS on Task::gradient, or on differences where the task has none. crs2: controlled
/// random search with local mutation. mlsl: multi-level single linkage with BOBYQA
/// inside.
enum class Search { subspace, quadratic, gradient, crs2, mlsl };

/// One search from `from` (unit cube) with a first step of `step`. Exact in `seed`. Infeasible
/// points count as a little worse than the worst feasible one seen.
Run nlopt_search(Search search, const Problem& problem, Ledger& ledger, std::uint64_t budget,
                 Point from, double step, std::uint64_t seed = 0);

}  // namespace chiaro::optimise
