// SPDX-License-Identifier: Apache-2.0
// Raking light shows what is carved or worn (Anderson and Levoy 2002; Stewart 2003): where the
// normal turns by a little, light changes by tan(incidence) times that.
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// How far tan / (1 + tan) of the mean incidence over bends stays below what is wanted; needs
/// shape.
std::optional<double> relief_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
