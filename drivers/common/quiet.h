// SPDX-License-Identifier: Apache-2.0
// When an unchanged universe may be left unsaid: four repeats first (a lost packet must not
// matter), then one at least every 0.8 s, so that no receiver believes the source has gone.
#pragma once

#include <chrono>

#include "controller/ports/output.h"

namespace chiaro::drivers {

/// Real-time.
class Quiet {
 public:
  static constexpr ports::Duration kKeepAlive = std::chrono::milliseconds(800);
  static constexpr int kRepeats = 4;

  explicit Quiet(bool on) : on_(on) {}
  /// Whether this frame must be sent now; counts it as sent if so.
  bool must_send(const ports::DmxFrame& frame, ports::TimePoint now) {
    if (!on_) return true;
    if (!any_ || frame.levels != last_) {
      last_ = frame.levels;
      any_ = true;
      repeats_ = 0;
    } else if (repeats_ < kRepeats) {
      ++repeats_;
    } else if (now - sent_ < kKeepAlive - kSlack) {
      return false;
    }
    sent_ = now;
    return true;
  }

 private:
  /// The loop comes by every 25 ms or so: better early than late.
  static constexpr ports::Duration kSlack = std::chrono::milliseconds(50);
  const bool on_;
  bool any_ = false;
  int repeats_ = 0;
  std::array<std::uint8_t, ports::kSlots> last_{};
  ports::TimePoint sent_;
};

}  // namespace chiaro::drivers
