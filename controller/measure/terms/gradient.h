// SPDX-License-Identifier: Apache-2.0
// The strength of the shading that tells shape.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// |T - T*| / max(T, T*).
std::optional<double> gradient_example(const Components& now, const Targets& wanted,
                                       const TermWeights& options);
/// |T - T*| / T*, T* the most that the scene can reach.
double gradient_ideal(const Components& now, const IdealTargets& wanted,
                      const TermWeights& options);

}  // namespace chiaro::measure::terms
