// SPDX-License-Identifier: Apache-2.0
// The spread of lightness over the surfaces: a standard deviation, as in the thesis.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// |s - s*| / max(s*, 127.5 - s*): no picture spreads more than 127.5.
std::optional<double> variance_example(const Components& now, const Targets& wanted,
                                       const TermWeights& options);
/// The same, towards a chosen spread.
double variance_ideal(const Components& now, const IdealTargets& wanted,
                      const TermWeights& options);

}  // namespace chiaro::measure::terms
