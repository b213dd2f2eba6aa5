// SPDX-License-Identifier: Apache-2.0
// CMA-ES (Hansen, "The CMA evolution strategy: a tutorial", 2016) with restarts in two regimes,
// large populations that double and small ones of random size (BIPOP, Hansen 2009). Candidates
// outside the box are mirrored into it.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_cmaes();

}  // namespace chiaro::optimise
