// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/tried_slots.h"

#include <algorithm>

namespace chiaro::daemon {

TriedSlots::TriedSlots(const studio::Studio& studio, const patch::Plan& plan)
    : owned_(plan.universes().size()) {
  const auto universes = plan.universes();
  for (const studio::Fixture& fixture : studio.fixtures) {
    const auto* patch = std::get_if<studio::DmxPatch>(&fixture.patch);
    if (patch == nullptr || fixture.profile.modes.empty()) continue;
    // The whole footprint: a slot that the mode leaves unused is still the lamp's.
    const int slots = fixture.profile.modes[fixture.mode].footprint;
    for (std::size_t u = 0; u < universes.size(); ++u)
      for (int i = 0; universes[u] == patch->universe && i < slots; ++i)
        owned_[u].set(std::min<std::size_t>(patch->address - 1u + static_cast<unsigned>(i),
                                            ports::kSlots - 1));
  }
}

void TriedSlots::take(const rig::Wanted& wanted) {
  tried_ = wanted.tried;
  const ports::TimePoint posted{std::chrono::nanoseconds(wanted.posted_ns)};
  const ports::TimePoint until{std::chrono::nanoseconds(wanted.tried_until_ns)};
  until_ = std::min(until, posted + kLongestTry);
}

void TriedSlots::raise(std::span<ports::DmxFrame> frames, ports::TimePoint now) const {
  if (now >= until_) return;
  for (const rig::TriedSlot& tried : tried_) {
    if (tried.slot < 1 || tried.slot > ports::kSlots) continue;
    const auto at = static_cast<std::size_t>(tried.slot - 1);
    for (std::size_t u = 0; u < frames.size() && u < owned_.size(); ++u)
      if (frames[u].universe == tried.universe && !owned_[u].test(at))
        frames[u].levels[at] = tried.level;
  }
}

}  // namespace chiaro::daemon
