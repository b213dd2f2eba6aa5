// SPDX-License-Identifier: Apache-2.0
// The loop around a search that looks over the whole box by itself: it is begun again elsewhere,
// with other random numbers, when it has shrunk to a point before the budget is used up.
#pragma once

#include "controller/optimise/nlopt_search.h"

namespace chiaro::optimise {

/// For Search::crs2 and Search::mlsl. One thread; exact in the task's seed.
Outcome whole_box(const Task& task, Search search);

}  // namespace chiaro::optimise
