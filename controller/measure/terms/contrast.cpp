// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/contrast.h"

#include <cmath>

#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {

std::optional<double> contrast_example(const Components& now, const Targets& wanted,
                                       const TermWeights&) {
  if (!wanted.contrast) return std::nullopt;
  return relative_difference(now.contrast, *wanted.contrast);
}

double contrast_ideal(const Components& now, const IdealTargets& wanted, const TermWeights&) {
  return wanted.contrast > 0 ? std::abs(now.contrast - wanted.contrast) / wanted.contrast : 0;
}

}  // namespace chiaro::measure::terms
