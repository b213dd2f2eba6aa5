// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/variance.h"

#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {

std::optional<double> variance_example(const Components& now, const Targets& wanted,
                                       const TermWeights&) {
  if (!wanted.variance) return std::nullopt;
  return spanned_difference(now.variance, *wanted.variance, 127.5);
}

double variance_ideal(const Components& now, const IdealTargets& wanted, const TermWeights&) {
  return spanned_difference(now.variance, wanted.variance, 127.5);
}

}  // namespace chiaro::measure::terms
