// SPDX-License-Identifier: Apache-2.0
// Warm light against cool shade tells shape where brightness cannot (Gooch and others 1998), as
// warm key and cool fill.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// |b* of the lighter half - b* of the darker half - wanted| over 40, at L* 50; needs colour.
std::optional<double> cool_warm_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
