// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/cool_warm.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace chiaro::measure::terms {

std::optional<double> cool_warm_cost(const Seen& seen, double wanted) {
  if (seen.colour == nullptr) return std::nullopt;
  std::vector<float> light;
  each_surface(*seen.map, [&](std::size_t i) { light.push_back(seen.luminance->values[i]); });
  if (light.empty()) return std::nullopt;
  const auto middle = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
  std::nth_element(light.begin(), middle, light.end());
  core::Rgb lit, shaded;
  each_surface(*seen.map, [&](std::size_t i) {
    core::Rgb& half = seen.luminance->values[i] > *middle ? lit : shaded;
    half = half + core::Rgb{seen.colour->red.values[i], seen.colour->green.values[i],
                            seen.colour->blue.values[i]};
  });
  const double apart = chroma_of(lit).b - chroma_of(shaded).b;
  return std::min(1.0, std::abs(apart - wanted) / 40);
}

}  // namespace chiaro::measure::terms
