// SPDX-License-Identifier: Apache-2.0
// Keeps what programs do to a lamp from flashing at people: at most three flashes in any second.
#pragma once

#include <array>
#include <cstddef>

#include "controller/ports/clock.h"

namespace chiaro::rig {

/// A flash is a pair of opposing changes of at least this fraction of full output, and no more
/// than three may fall into any second (WCAG 2.3.1; ITU-R BT.1702 has the same bound).
inline constexpr double kFlashDepth = 0.1;
inline constexpr std::size_t kFlashesPerSecond = 3;

/// For one level of one lamp. Real-time; times must not go back.
class FlashGuard {
 public:
  explicit FlashGuard(double level = 0) : extreme_(level) {}

  /// The level that may be sent for a program's `wanted`: itself, or, where turning round once
  /// more would be one swing too many, a level short of a swing. It follows as soon as it may.
  double allow(double wanted, ports::TimePoint now);
  /// A person's own move: passed as it is, and not counted.
  void follow(double level) {
    extreme_ = level;
    direction_ = 0;
  }

 private:
  static constexpr std::size_t kSwings = 2 * kFlashesPerSecond;
  bool may_swing(ports::TimePoint now) const;

  double extreme_;     ///< the furthest level since the last turn
  int direction_ = 0;  ///< +1 rising, -1 falling, 0 not yet
  std::array<ports::TimePoint, kSwings> swings_{};
  std::size_t oldest_ = 0, counted_ = 0;
};

}  // namespace chiaro::rig
