// SPDX-License-Identifier: Apache-2.0
// The thesis's genetic algorithm [I-26]: real-coded, 30 members, elite 10 %, crossover 80 %,
// mutation 20 %. Selection and operators are not printed; ours: tournaments of two, blend crossover
// (0.5 beyond both parents, kept in the box), a normal change of one gene.
#pragma once

#include <memory>

#include "controller/optimise/optimiser.h"

namespace chiaro::optimise {

std::unique_ptr<Optimiser> make_genetic();

}  // namespace chiaro::optimise
