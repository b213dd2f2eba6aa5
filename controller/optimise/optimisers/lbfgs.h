// SPDX-License-Identifier: Apache-2.0
// Multi-start bounded L-BFGS (Luksan's, from NLopt) for costs whose gradient is known; without one
// it takes differences, two trials a variable.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_lbfgs();

}  // namespace chiaro::optimise
