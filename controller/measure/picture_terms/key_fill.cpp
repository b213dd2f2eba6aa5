// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/key_fill.h"

#include <algorithm>
#include <cmath>

namespace chiaro::measure::terms {

std::optional<double> key_fill_cost(const Seen& seen, double wanted) {
  if (!seen.key || !seen.fill) return std::nullopt;
  constexpr double kMost = 10;  // stops: beyond that a lamp is dark
  const double stops = *seen.key <= 0 ? -kMost
                       : *seen.fill <= 0
                           ? kMost
                           : std::clamp(std::log2(*seen.key / *seen.fill), -kMost, kMost);
  return std::min(1.0, std::abs(stops - std::log2(wanted)) / 4);
}

}  // namespace chiaro::measure::terms
