// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/clipped.h"

#include <algorithm>

namespace chiaro::measure::terms {

std::optional<double> clipped_cost(const Seen& seen, double wanted) {
  double burnt = 0, all = 0;
  each_surface(*seen.map, [&](std::size_t i) {
    ++all;
    burnt += seen.luminance->values[i] >= 1;
  });
  return all > 0 ? std::clamp(4 * (burnt / all - wanted), 0.0, 1.0) : 0;
}

}  // namespace chiaro::measure::terms
