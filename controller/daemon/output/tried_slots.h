// SPDX-License-Identifier: Apache-2.0
// A lamp without a profile is learned by raising one slot after another while a person looks. This
// is the one way to a slot past the levels that `rig` allows, so it is narrow: only slots that no
// fixture of the studio has, never in a blackout, and back at 0 by themselves when the person (or
// the brain) goes away.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <span>
#include <vector>

#include "controller/patch/plan.h"
#include "controller/ports/clock.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// However far ahead the brain's word reaches, no slot stays raised longer without a new word.
inline constexpr ports::Duration kLongestTry = std::chrono::seconds(10);

class TriedSlots {
 public:
  TriedSlots(const studio::Studio& studio, const patch::Plan& plan);
  /// Real-time, both. Slots that a fixture has, and universes that are not the studio's, are left
  /// alone.
  void take(const rig::Wanted& wanted);
  void raise(std::span<ports::DmxFrame> frames, ports::TimePoint now) const;

 private:
  std::vector<std::bitset<ports::kSlots>> owned_;  ///< by universe, as the plan has them
  std::array<rig::TriedSlot, rig::kTriedSlots> tried_{};
  ports::TimePoint until_{};
};

}  // namespace chiaro::daemon
