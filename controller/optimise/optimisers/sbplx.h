// SPDX-License-Identifier: Apache-2.0
// Multi-start SBPLX (Rowan's subspace-searching simplex, from NLopt), the default; see
// multi_start.h.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_sbplx();

}  // namespace chiaro::optimise
