// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/edge.h"

#include <cmath>

#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {

std::optional<double> edge_example(const Components& now, const Targets& wanted,
                                   const TermWeights&) {
  if (!wanted.edge) return std::nullopt;
  return std::abs(now.edge - *wanted.edge);
}

double edge_ideal(const Components& now, const IdealTargets&, const TermWeights&) {
  return 1 - now.edge;
}

}  // namespace chiaro::measure::terms
