// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>

#include "controller/measure/kernels.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

double mean_contrast(const PixelIndex& index, std::vector<float> sums) {
  if (index.crossings.empty()) return 0;
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= index.run_length[k];
  double total = 0;
  for (const auto [i, j] : index.crossings) {
    const float both = sums[i] + sums[j];
    total += both > 0 ? static_cast<double>(std::abs(sums[i] - sums[j]) / both) : 0.0;
  }
  return total / static_cast<double>(index.crossings.size());
}

Components assembled(kernels::PassSums sums, const PixelMap& map) {
  Components out;
  if (sums.weight > 0) {
    const double first = sums.first / sums.weight;
    out.mean = static_cast<double>(sums.shift) + first;
    out.variance = std::sqrt(std::max(0.0, sums.second / sums.weight - first * first));
  }
  if (map.surfaces > 0)
    out.gradient = std::sqrt(sums.squared_gradient / static_cast<double>(map.surfaces));
  if (sums.edge_weight > 0) out.edge = sums.edge_found / sums.edge_weight;
  out.contrast = mean_contrast(map.index, std::move(sums.run_sums));
  const auto counted = static_cast<double>(map.surfaces + map.edges);
  for (std::size_t k = 0; k < 256 && counted > 0; ++k)
    out.histogram[k] = sums.histogram[k] / counted;
  return out;
}

Components measured(const core::Plane& source, bool is_luminance, const PixelMap& map,
                    const core::Plane* lit, const MeasureOptions& options) {
  assert(source.size == map.type.size && (!lit || lit->size == source.size));
  if (source.empty()) return {};
  kernels::PassInput in;
  in.source = &source;
  in.is_luminance = is_luminance;
  in.map = &map;
  in.lit = lit;
  in.edge_threshold = static_cast<float>(options.edge_threshold);
  in.shadow_edge_weight = static_cast<float>(options.shadow_edge_weight);
  return assembled(kernels::pass(in), map);
}

}  // namespace

core::Plane working_scalar(const core::Plane& luminance) {
  core::Plane out(luminance.size);
  kernels::working_scalar(luminance.values.data(), out.values.data(), out.values.size());
  return out;
}

Components components(const core::Plane& values, const PixelMap& map, const core::Plane* lit,
                      const MeasureOptions& options) {
  return measured(values, false, map, lit, options);
}

Components components_of_luminance(const core::Plane& luminance, const PixelMap& map,
                                   const core::Plane* lit, const MeasureOptions& options) {
  return measured(luminance, true, map, lit, options);
}

Targets targets_of(const Components& components, bool geometry_known) {
  Targets out;
  out.mean = components.mean;
  out.gradient = components.gradient;
  out.variance = components.variance;
  out.histogram = components.histogram;
  if (geometry_known) {
    out.edge = components.edge;
    out.contrast = components.contrast;
  }
  return out;
}

}  // namespace chiaro::measure
