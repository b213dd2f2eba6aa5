// SPDX-License-Identifier: Apache-2.0
// Colour as in the exemplar, whatever its brightness.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// |distance of the mean colours in a*b* at L* 50 - wanted| over 60; needs colour and an exemplar.
std::optional<double> chroma_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
