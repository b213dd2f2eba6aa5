// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/silhouette.h"

#include <algorithm>
#include <cmath>

#include "controller/measure/filters.h"

namespace chiaro::measure::terms {

std::optional<double> silhouette_cost(const Seen& seen, double wanted) {
  if (seen.map->externals == 0) return std::nullopt;
  const core::Plane steps = sobel_magnitude(working_scalar(*seen.luminance));
  double shown = 0;
  for (std::size_t i = 0; i < steps.values.size(); ++i)
    if (seen.map->external.values[i] != 0) shown += std::min(1.0, double{steps.values[i]} / 16);
  return std::clamp(wanted - shown / static_cast<double>(seen.map->externals), 0.0, 1.0);
}

}  // namespace chiaro::measure::terms
