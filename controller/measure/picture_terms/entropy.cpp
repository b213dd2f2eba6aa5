// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/entropy.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro::measure::terms {

std::optional<double> entropy_cost(const Seen& seen, double wanted) {
  constexpr std::size_t kBins = 30;
  constexpr double kBent = 0.2;  // radians a pixel, from where on a bend counts in full
  std::array<double, kBins> bins{};
  double all = 0;
  each_surface(*seen.map, [&](std::size_t i) {
    const double bend = seen.curvature != nullptr ? double{seen.curvature->values[i]} : kBent;
    const double weight = 0.25 + 0.75 * std::min(1.0, bend / kBent);
    const double l = std::clamp(lightness_at(seen, i), 0.0, 99.999);
    bins[static_cast<std::size_t>(l / 100 * kBins)] += weight;
    all += weight;
  });
  if (all <= 0) return wanted;
  double entropy = 0;
  for (const double bin : bins)
    if (bin > 0) entropy -= bin / all * std::log(bin / all);
  return std::clamp(wanted - entropy / std::log(static_cast<double>(kBins)), 0.0, 1.0);
}

}  // namespace chiaro::measure::terms
