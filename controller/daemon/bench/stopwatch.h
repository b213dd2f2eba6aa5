// SPDX-License-Identifier: Apache-2.0
// Timing by the world's clock. Work is repeated a fixed number of times, never "until it has taken
// a second", so that a test on a fake clock ends too.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "controller/ports/clock.h"

namespace chiaro::daemon::bench {

class Stopwatch {
 public:
  explicit Stopwatch(const ports::Clock& clock) : clock_(clock), from_(clock.now()) {}
  double seconds() const { return std::chrono::duration<double>(clock_.now() - from_).count(); }

 private:
  const ports::Clock& clock_;
  ports::TimePoint from_;
};

inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Microseconds of one call: the least of `rounds` averages over `calls`. The least, because other
/// programs can only add to it.
template <class Body>
double best_us(const ports::Clock& clock, int rounds, int calls, Body body) {
  body();
  double best = 1e300;
  for (int r = 0; r < rounds; ++r) {
    const Stopwatch watch(clock);
    for (int c = 0; c < calls; ++c) body();
    best = std::min(best, watch.seconds() * 1e6 / calls);
  }
  return best;
}

/// Seconds of one call: the median of `rounds`.
template <class Body>
double median_s(const ports::Clock& clock, int rounds, Body body) {
  std::vector<double> times;
  for (int r = 0; r < rounds; ++r) {
    const Stopwatch watch(clock);
    body();
    times.push_back(watch.seconds());
  }
  return median(std::move(times));
}

}  // namespace chiaro::daemon::bench
