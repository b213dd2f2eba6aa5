// SPDX-License-Identifier: Apache-2.0
// Burnt-out pixels show nothing of the subject.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// Four times the share of the surface at or above white beyond what is wanted, at most 1.
std::optional<double> clipped_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
