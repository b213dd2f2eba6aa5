// SPDX-License-Identifier: Apache-2.0
// How much neighbouring parts differ in lightness: Michelson's form, 0..1.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// |C - C*| / max(C, C*).
std::optional<double> contrast_example(const Components& now, const Targets& wanted,
                                       const TermWeights& options);
/// |C - C*| / C*, C* the most that the scene can reach.
double contrast_ideal(const Components& now, const IdealTargets& wanted,
                      const TermWeights& options);

}  // namespace chiaro::measure::terms
