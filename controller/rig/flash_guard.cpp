// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/flash_guard.h"

#include <algorithm>
#include <cmath>

namespace chiaro::rig {
namespace {
/// Just short of a flash: a held level must not itself count as a swing.
constexpr double kShort = 0.999 * kFlashDepth;
}  // namespace

bool FlashGuard::may_swing(ports::TimePoint now) const {
  return counted_ < kSwings || now - swings_[oldest_] >= std::chrono::seconds(1);
}

double FlashGuard::allow(double wanted, ports::TimePoint now) {
  const bool beyond = direction_ > 0   ? wanted >= extreme_
                      : direction_ < 0 ? wanted <= extreme_
                                       : false;
  if (beyond) return extreme_ = wanted;  // further the same way: not a new swing
  const double back = wanted - extreme_;
  if (std::abs(back) < kFlashDepth) return wanted;
  if (!may_swing(now)) return extreme_ + (back > 0 ? kShort : -kShort);
  swings_[oldest_] = now;
  oldest_ = (oldest_ + 1) % kSwings;
  counted_ = std::min(counted_ + 1, kSwings);
  direction_ = back > 0 ? 1 : -1;
  return extreme_ = wanted;
}

}  // namespace chiaro::rig
