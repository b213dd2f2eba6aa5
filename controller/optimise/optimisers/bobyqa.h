// SPDX-License-Identifier: Apache-2.0
// Multi-start BOBYQA (Powell 2009, from NLopt): local quadratic models, few trials where the cost
// is smooth.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_bobyqa();

}  // namespace chiaro::optimise
