// SPDX-License-Identifier: Apache-2.0
// Multi-start SBPLX (Rowan's subspace-searching simplex, from NLopt), the default: a fifth of the
// budget samples the box evenly; the best samples that lie apart are searched locally; the best
// ends are refined with what is left; then another round, until the budget is used.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_sbplx();

}  // namespace chiaro::optimise
