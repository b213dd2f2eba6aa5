// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/chroma.h"

#include <algorithm>
#include <cmath>

namespace chiaro::measure::terms {

std::optional<double> chroma_cost(const Seen& seen, double wanted) {
  if (seen.colour == nullptr || !seen.exemplar_chroma) return std::nullopt;
  core::Rgb sum;
  each_surface(*seen.map, [&](std::size_t i) {
    sum = sum + core::Rgb{seen.colour->red.values[i], seen.colour->green.values[i],
                          seen.colour->blue.values[i]};
  });
  const core::Lab ours = chroma_of(sum);
  const double apart =
      std::hypot(ours.a - seen.exemplar_chroma->a, ours.b - seen.exemplar_chroma->b);
  return std::min(1.0, std::abs(apart - wanted) / 60);
}

}  // namespace chiaro::measure::terms
