// SPDX-License-Identifier: Apache-2.0
// What the hand does when nobody speaks to it: holds, or fades to each lamp's safe level after the
// time that the studio file says, and back as gently when it is spoken to again.
#pragma once

#include "controller/ports/clock.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

/// A brain is silent when its newest word is older than this.
inline constexpr ports::Duration kSilence = std::chrono::seconds(1);

/// Real-time.
class Watch {
 public:
  Watch(const studio::Safety& safety, ports::TimePoint now) : safety_(safety), last_word_(now) {}
  /// A word that was posted then has been understood.
  void heard(ports::TimePoint posted, ports::TimePoint now);
  /// Words come, but of another studio or in another layout.
  void refuse(bool refused) { refused_ = refused; }
  bool refused() const { return refused_; }
  bool silent(ports::TimePoint now) const { return !heard_ || now - last_word_ > kSilence; }
  Caution judge(ports::TimePoint now, double elapsed, bool blackout);
  /// 0 = as wanted, 1 = every lamp at its safe level.
  double safe_progress() const { return safe_progress_; }
  /// The same silence goes on under another studio file, refused until the brain speaks of it.
  void carry(const Watch& before);

 private:
  studio::Safety safety_;
  ports::TimePoint last_word_;
  bool heard_ = false, refused_ = false;
  double safe_progress_ = 0;
};

}  // namespace chiaro::rig
