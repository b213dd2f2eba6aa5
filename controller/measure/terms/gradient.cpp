// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/gradient.h"

#include <cmath>

#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {

std::optional<double> gradient_example(const Components& now, const Targets& wanted,
                                       const TermWeights&) {
  if (!wanted.gradient) return std::nullopt;
  return relative_difference(now.gradient, *wanted.gradient);
}

double gradient_ideal(const Components& now, const IdealTargets& wanted, const TermWeights&) {
  return wanted.gradient > 0 ? std::abs(now.gradient - wanted.gradient) / wanted.gradient : 0;
}

}  // namespace chiaro::measure::terms
