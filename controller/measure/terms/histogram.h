// SPDX-License-Identifier: Apache-2.0
// How many pixels of each grey level.
#pragma once

#include <optional>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// The distance of the two histograms, 0..1, of the kind that the options choose.
std::optional<double> histogram_example(const Components& now, const Targets& wanted,
                                        const TermWeights& options);
/// Half the sum of |share - 1 / 256|, or its earth mover's form: an equalised picture.
double histogram_ideal(const Components& now, const IdealTargets& wanted,
                       const TermWeights& options);

}  // namespace chiaro::measure::terms
