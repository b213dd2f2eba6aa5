// SPDX-License-Identifier: Apache-2.0
// The outline stands out from what is behind it (Light Collages' silhouette light).
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// How far the share of the outline that shows, a step of 16 grey levels a pixel being all, stays
/// below what is wanted; needs an outline.
std::optional<double> silhouette_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
