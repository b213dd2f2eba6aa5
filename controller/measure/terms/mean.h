// SPDX-License-Identifier: Apache-2.0
// The average lightness of the surfaces, cast shadows left out.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// |mu - mu*| / max(mu*, 255 - mu*).
std::optional<double> mean_example(const Components& now, const Targets& wanted,
                                   const TermWeights& options);
/// The same, towards a chosen mid grey.
double mean_ideal(const Components& now, const IdealTargets& wanted, const TermWeights& options);

}  // namespace chiaro::measure::terms
