// SPDX-License-Identifier: Apache-2.0
// Local searches from many places: a fifth of the budget samples the box evenly; the best samples
// that lie apart are searched locally; the best ends are refined with what is left; then another
// round, until the budget is used. What "locally" means is the caller's.
#pragma once

#include <functional>

#include "controller/optimise/search.h"

namespace chiaro::optimise {

/// From `from` (unit cube) with a first step of `step`, at most `budget` evaluations.
using LocalSearch = std::function<Run(const Problem& problem, Ledger& ledger, std::uint64_t budget,
                                      Point from, double step)>;

Outcome multi_start(const Task& task, const LocalSearch& local);

}  // namespace chiaro::optimise
