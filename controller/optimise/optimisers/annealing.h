// SPDX-License-Identifier: Apache-2.0
// The thesis's simulated annealing [I-27]: the temperature falls by a tenth per iteration, from one
// at which half of the uphill moves at the start are taken (the thesis's "equal probabilities"
// would need an infinite one). Moves and chain length are not printed; ours: one variable at a
// time, a normal step that shrinks with the root of the temperature, chains that spread the
// schedule over the budget. One sequence, whatever the threads.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_annealing();

}  // namespace chiaro::optimise
