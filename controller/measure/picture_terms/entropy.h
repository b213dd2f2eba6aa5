// SPDX-License-Identifier: Apache-2.0
// Illumination entropy (Gumhold 2002): a picture that uses its grey levels evenly tells most.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// How far the entropy of L* over 30 bins, bends counting more, stays below the wanted share of
/// ln 30.
std::optional<double> entropy_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
