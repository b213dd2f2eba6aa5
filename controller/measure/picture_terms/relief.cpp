// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/relief.h"

#include <algorithm>
#include <cmath>

namespace chiaro::measure::terms {

std::optional<double> relief_cost(const Seen& seen, double wanted) {
  if (seen.curvature == nullptr) return std::nullopt;
  constexpr double kFlat = 0.01, kTorn = 0.6;  // radians a pixel: nothing to see; an edge
  const int width = seen.map->type.size.width;
  double steps = 0, turns = 0;
  each_surface(*seen.map, [&](std::size_t i) {
    const double turn = seen.curvature->values[i];
    if (turn < kFlat || turn > kTorn ||
        static_cast<int>(i % static_cast<std::size_t>(width)) + 1 >= width)
      return;
    const std::size_t below = i + static_cast<std::size_t>(width);
    if (below >= seen.luminance->values.size()) return;
    const double here = seen.luminance->values[i];
    const double right = std::abs(double{seen.luminance->values[i + 1]} - here);
    const double down = std::abs(double{seen.luminance->values[below]} - here);
    // As a share of the light there: of a black pixel nothing can be said.
    if (here > 1e-4) steps += std::min(4 * turn, std::max(right, down) / here);
    turns += turn;
  });
  if (turns <= 0) return std::nullopt;
  const double tangent = steps / turns;
  return std::clamp(wanted - tangent / (1 + tangent), 0.0, 1.0);
}

}  // namespace chiaro::measure::terms
