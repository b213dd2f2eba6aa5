// SPDX-License-Identifier: Apache-2.0
// Controlled random search with local mutation (Price 1983; Kaelo and Ali 2006; from NLopt): a
// population of points whose worst member is replaced by reflections among random others.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_crs2();

}  // namespace chiaro::optimise
