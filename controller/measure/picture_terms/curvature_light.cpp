// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/curvature_light.h"

#include <algorithm>
#include <cmath>

namespace chiaro::measure::terms {

std::optional<double> curvature_light_cost(const Seen& seen, double wanted) {
  if (seen.curvature == nullptr) return std::nullopt;
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  each_surface(*seen.map, [&](std::size_t i) {
    const double bend = seen.curvature->values[i], light = lightness_at(seen, i);
    ++n;
    x += bend;
    y += light;
    xx += bend * bend;
    yy += light * light;
    xy += bend * light;
  });
  const double spread = (n * xx - x * x) * (n * yy - y * y);
  const double correlation = spread > 1e-12 * n ? (n * xy - x * y) / std::sqrt(spread) : 0;
  return std::clamp((wanted - correlation) / 2, 0.0, 1.0);
}

}  // namespace chiaro::measure::terms
