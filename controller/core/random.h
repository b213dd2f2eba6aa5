// SPDX-License-Identifier: Apache-2.0
// A small random generator whose sequence is ours: the standard's distributions differ between
// libraries, and a seed must give the same look everywhere.
#pragma once

#include <cmath>
#include <cstdint>

#include "controller/core/units.h"

namespace chiaro::core {

/// PCG32 (O'Neill 2014, "PCG: a family of simple fast space-efficient statistically good
/// algorithms"). Streams with different `stream` are independent: give each task its own.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : step_((stream << 1u) | 1u) {
    next();
    state_ += seed;
    next();
  }
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + step_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto turn = static_cast<std::uint32_t>(old >> 59u);
    return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
  }
  /// [0, 1)
  double uniform() { return next() * 0x1p-32; }
  double uniform(double least, double most) { return least + (most - least) * uniform(); }
  /// Mean 0, standard deviation 1 (Box-Muller; two draws each).
  double normal() {
    const double r = std::sqrt(-2 * std::log(1 - uniform()));
    return r * std::cos(2 * kPi * uniform());
  }
  /// 0 .. n-1. Precondition: n > 0. The bias of 2^-32 n does not matter here.
  std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * n) >> 32u);
  }

 private:
  std::uint64_t state_ = 0, step_;
};

}  // namespace chiaro::core
