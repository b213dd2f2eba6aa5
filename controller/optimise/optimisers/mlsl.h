// SPDX-License-Identifier: Apache-2.0
// Multi-level single linkage (Rinnooy Kan and Timmer 1987; from NLopt): random samples, a
// local search (BOBYQA) from each that no better one lies near.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_mlsl();

}  // namespace chiaro::optimise
