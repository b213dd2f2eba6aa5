// SPDX-License-Identifier: Apache-2.0
// The one clock seam. Stages never own a clock: time is an argument. Only program loops hold one.
#pragma once

#include <chrono>

namespace chiaro::ports {

/// CLOCK_MONOTONIC: brain and hand share it, so a fade means the same in both.
using TimePoint = std::chrono::time_point<std::chrono::steady_clock, std::chrono::nanoseconds>;
using Duration = std::chrono::nanoseconds;

/// Thread-safe.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual TimePoint now() const = 0;
  /// Returns at or after `deadline` (an absolute time: no drift).
  virtual void sleep_until(TimePoint deadline) = 0;
};

}  // namespace chiaro::ports
