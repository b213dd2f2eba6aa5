// SPDX-License-Identifier: Apache-2.0
// How far the gaps between frames stray from their period: a histogram with eight steps an octave,
// fixed in size because the output loop fills it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>

#include "controller/ports/clock.h"

namespace chiaro::daemon {

class Jitter {
 public:
  /// Real-time.
  void add(ports::Duration deviation) {
    const auto ns = static_cast<std::uint64_t>(std::abs(deviation.count()));
    ++counts_[std::min(step_of(ns), kSteps - 1)];
    ++total_;
  }
  /// The least deviation, to the next step up (at most 12 % too much), that `share` of the gaps
  /// keep within; microseconds. 0 when there was no gap yet.
  double microseconds(double share) const {
    const double wanted = share * static_cast<double>(total_);
    double seen = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      seen += static_cast<double>(counts_[i]);
      if (seen > 0 && seen >= wanted) return i == 0 ? 0 : upper_edge_ns(i) * 1e-3;
    }
    return 0;
  }
  std::uint64_t total() const { return total_; }

 private:
  // Step 0 holds everything below 1024 ns; steps above split each power of two in eight.
  static constexpr std::size_t kSteps = 1 + 8 * 24;
  static std::size_t step_of(std::uint64_t ns) {
    if (ns < 1024) return 0;
    const auto top = static_cast<unsigned>(std::bit_width(ns)) - 1;
    return 1 + (top - 10) * 8 + (ns >> (top - 3) & 7u);
  }
  static double upper_edge_ns(std::size_t step) {
    const std::size_t octave = (step - 1) / 8, part = (step - 1) % 8;
    return static_cast<double>((8 + part + 1) << (octave + 7));
  }
  std::array<std::uint32_t, kSteps> counts_{};
  std::uint64_t total_ = 0;
};

}  // namespace chiaro::daemon
