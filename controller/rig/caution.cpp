// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/caution.h"

#include <algorithm>

namespace chiaro::rig {

void Watch::heard(ports::TimePoint posted, ports::TimePoint now) {
  heard_ = true;
  last_word_ = std::max(last_word_, std::min(posted, now));
}

Caution Watch::judge(ports::TimePoint now, double elapsed, bool blackout) {
  const double silence = std::chrono::duration<double>(now - last_word_).count();
  const bool to_safe = !refused_ && safety_.fade_to_safe_after_s &&
                       silence >= *safety_.fade_to_safe_after_s && silent(now);
  const double reach = safety_.fade_to_safe_s > 0 ? elapsed / safety_.fade_to_safe_s : 1;
  // The way back is as gentle as the way there: no lamp jumps because a program came back.
  safe_progress_ = std::clamp(safe_progress_ + (to_safe ? reach : -reach), 0.0, 1.0);
  if (blackout) return Caution::blackout;
  if (to_safe || safe_progress_ > 0) return Caution::fade_to_safe;
  return silent(now) || refused_ ? Caution::hold : Caution::normal;
}

void Watch::carry(const Watch& before) {
  heard_ = before.heard_;
  last_word_ = before.last_word_;
  safe_progress_ = before.safe_progress_;
  refused_ = true;
}

}  // namespace chiaro::rig
