// SPDX-License-Identifier: Apache-2.0
// The thesis's "steepest descent" [I-25], which is a greedy coordinate search: each variable is
// stepped up and down, the best of all steps is kept, and when none gains the step is halved, down
// to a thousandth of the range; then the next start. The step is not printed; ours begins at 1/8.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_descent();

}  // namespace chiaro::optimise
