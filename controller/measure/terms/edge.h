// SPDX-License-Identifier: Apache-2.0
// The share of the shape's edges that the picture shows.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// |share - target|.
std::optional<double> edge_example(const Components& now, const Targets& wanted,
                                   const TermWeights& options);
/// 1 - share: every edge should show.
double edge_ideal(const Components& now, const IdealTargets& wanted, const TermWeights& options);

}  // namespace chiaro::measure::terms
