// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/histogram.h"

#include <cmath>

namespace chiaro::measure {

double histogram_distance(const std::array<double, 256>& a, const std::array<double, 256>& b,
                          HistogramDistance kind) {
  double sum = 0, moved = 0;
  for (std::size_t k = 0; k < 256; ++k) {
    const double d = a[k] - b[k];
    moved += d;
    sum += std::abs(kind == HistogramDistance::half_l1 ? d / 2 : moved / 255);
  }
  return sum;
}

namespace terms {
namespace {

constexpr std::array<double, 256> kEqualised = [] {
  std::array<double, 256> shares{};
  for (double& share : shares) share = 1.0 / 256;
  return shares;
}();

}  // namespace

std::optional<double> histogram_example(const Components& now, const Targets& wanted,
                                        const TermWeights& options) {
  if (!wanted.histogram) return std::nullopt;
  return histogram_distance(now.histogram, *wanted.histogram, options.histogram_by);
}

double histogram_ideal(const Components& now, const IdealTargets&, const TermWeights& options) {
  return histogram_distance(now.histogram, kEqualised, options.histogram_by);
}

}  // namespace terms
}  // namespace chiaro::measure
