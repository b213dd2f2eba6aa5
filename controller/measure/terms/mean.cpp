// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/mean.h"

#include "controller/measure/terms/term.h"

namespace chiaro::measure::terms {

std::optional<double> mean_example(const Components& now, const Targets& wanted,
                                   const TermWeights&) {
  if (!wanted.mean) return std::nullopt;
  return spanned_difference(now.mean, *wanted.mean, 255);
}

double mean_ideal(const Components& now, const IdealTargets& wanted, const TermWeights&) {
  return spanned_difference(now.mean, wanted.mean, 255);
}

}  // namespace chiaro::measure::terms
