// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/haar.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "controller/measure/kernels.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

/// Builds the pyramid bottom-up in O(pixels); `keep(level, side, horizontal, vertical)` gets each
/// level from the finest to level 0. Returns the mean.
template <class Keep>
double pyramid(const core::Plane& square, Keep keep) {
  const auto side = static_cast<std::size_t>(square.size.width);
  assert(square.size.width == square.size.height && std::has_single_bit(side) && side >= 2);
  std::vector<float> here(side * side / 4), next(side * side / 4);
  const float* in = square.values.data();
  int level = haar_levels(square.size.width) - 1;
  for (std::size_t half = side / 2; half >= 1; half /= 2, --level) {
    const auto [h, v] = keep(level, half);
    kernels::haar_level(in, half, half, 1, next.data(), h, v);
    here.swap(next);
    in = here.data();
  }
  return static_cast<double>(here.front());
}

template <class Difference>
double summed_levels(const HaarSpectrum& a, const HaarSpectrum& b, Difference difference) {
  double sum = 0;
  for (std::size_t level = 0; level < a.horizontal.size(); ++level) {
    double here = 0;
    for (std::size_t i = 0; i < a.horizontal[level].size(); ++i)
      here += difference(double{a.horizontal[level][i]} - double{b.horizontal[level][i]},
                         double{a.vertical[level][i]} - double{b.vertical[level][i]});
    sum += here * haar_level_weight(a.side, static_cast<int>(level));
  }
  return sum;
}

}  // namespace

int haar_levels(int side) { return std::countr_zero(static_cast<unsigned>(side)); }

double haar_mean_weight(int side) { return 1.0 / (haar_levels(side) + 1); }

double haar_level_weight(int side, int level) {
  return haar_mean_weight(side) / (2 * std::ldexp(1.0, 2 * level));
}

HaarSpectrum haar_spectrum(const core::Plane& values, int side) {
  assert(side >= 2 && std::has_single_bit(static_cast<unsigned>(side)));
  HaarSpectrum out;
  out.side = side;
  const auto levels = static_cast<std::size_t>(haar_levels(side));
  out.horizontal.resize(levels);
  out.vertical.resize(levels);
  const auto keep = [&](int level, std::size_t nodes) {
    auto &h = out.horizontal[static_cast<std::size_t>(level)],
         &v = out.vertical[static_cast<std::size_t>(level)];
    h.resize(nodes * nodes);
    v.resize(nodes * nodes);
    return std::pair(h.data(), v.data());
  };
  const core::Size square{side, side};
  out.mean =
      values.size == square ? pyramid(values, keep) : pyramid(core::resized(values, square), keep);
  return out;
}

double haar_distance(const HaarSpectrum& a, const HaarSpectrum& b) {
  assert(a.side == b.side);
  const double mean = a.mean - b.mean;
  return std::sqrt(mean * mean * haar_mean_weight(a.side) +
                   summed_levels(a, b, [](double h, double v) { return h * h + v * v; }));
}

double haar_distance_as_printed(const HaarSpectrum& a, const HaarSpectrum& b) {
  assert(a.side == b.side);
  double sum = 0, nodes = 0;
  for (std::size_t level = 0; level < a.horizontal.size(); ++level) {
    for (std::size_t i = 0; i < a.horizontal[level].size(); ++i) {
      const double d = double{a.horizontal[level][i]} + double{a.vertical[level][i]} -
                       double{b.horizontal[level][i]} - double{b.vertical[level][i]};
      sum += d * d;
    }
    nodes += static_cast<double>(a.horizontal[level].size());
  }
  return std::sqrt(sum) / nodes;
}

}  // namespace chiaro::measure
