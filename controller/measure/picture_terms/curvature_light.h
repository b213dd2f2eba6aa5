// SPDX-License-Identifier: Apache-2.0
// Light where the surface bends (Lee, Hao and Varshney 2006, Light Collages, whose diffuse lights
// shine in proportion to curvature).
#pragma once

#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::measure::terms {

/// Half of how far the correlation of L* with curvature stays below what is wanted; needs shape.
std::optional<double> curvature_light_cost(const Seen& seen, double wanted);

}  // namespace chiaro::measure::terms
