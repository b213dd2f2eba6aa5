// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimiser.h"

#include "controller/optimise/optimisers/annealing.h"
#include "controller/optimise/optimisers/bobyqa.h"
#include "controller/optimise/optimisers/cmaes.h"
#include "controller/optimise/optimisers/crs2.h"
#include "controller/optimise/optimisers/descent.h"
#include "controller/optimise/optimisers/genetic.h"
#include "controller/optimise/optimisers/lbfgs.h"
#include "controller/optimise/optimisers/mlsl.h"
#include "controller/optimise/optimisers/sbplx.h"

namespace chiaro::optimise {

std::span<const OptimiserEntry> optimisers() {
  static constexpr OptimiserEntry kOptimisers[] = {
#define OPTIMISER(name, summary) {#name, summary, make_##name},
#include "controller/optimise/optimisers.def"
#undef OPTIMISER
  };
  return kOptimisers;
}

std::unique_ptr<Optimiser> make_optimiser(std::string_view name) {
  for (const OptimiserEntry& entry : optimisers())
    if (entry.name == name) return entry.make();
  return nullptr;
}

}  // namespace chiaro::optimise
