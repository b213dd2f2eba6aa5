// SPDX-License-Identifier: Apache-2.0
// The ratio of key to fill, as photographers set it.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// |stops between the ratio and what is wanted| over 4; needs both kinds of lamp.
std::optional<double> key_fill_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
