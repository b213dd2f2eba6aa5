// SPDX-License-Identifier: Apache-2.0
// What the governor reports, and how another goes on where it is.
#include <algorithm>

#include "controller/rig/governor.h"
#include "controller/rig/governor_state.h"

namespace chiaro::rig {

using core::Dof;
using core::kDofs;

Sent Governor::empty_report() const {
  Sent sent;
  const std::size_t lamps = state_->lamps.size();
  sent.fixtures.resize(lamps);
  sent.held.resize(lamps);
  sent.marks.resize(lamps);
  sent.own_marks.resize(lamps);
  sent.limited.resize(lamps);
  sent.circuits.resize(state_->power.circuits().size());
  for (auto& source : sent.sources) source.fixtures.resize(lamps);
  return sent;
}

void Governor::report(Sent& into) const {
  const State& s = *state_;
  into.studio_fingerprint = s.fingerprint;
  into.sent_ns = s.last_step.time_since_epoch().count();
  std::copy(s.levels.fixtures_.begin(), s.levels.fixtures_.end(), into.fixtures.begin());
  into.axes_waiting = 0;
  for (std::size_t i = 0; i < s.lamps.size(); ++i) {
    for (std::size_t d = 0; d < kDofs; ++d)
      if (s.lamps[i].can(d)) into.held[i].set(static_cast<Dof>(d), s.sources.track(i, d).sent);
    if (s.is_parked[i] != 0) into.held[i] = s.parked[i];
    into.axes_waiting += s.axes_waiting[i];
  }
  for (std::size_t k = 0; k < kSources; ++k) {
    const SourceState& from = s.sources.word(k);
    std::copy(from.fixtures.begin(), from.fixtures.end(), into.sources[k].fixtures.begin());
    into.fade_id[k] = into.sources[k].fade_id = from.fade_id;
    into.sources[k].fade_s = from.fade_s;
    into.fade_progress[k] = s.sources.progress_of(k, s.last_step);
  }
  std::copy(s.marks.begin(), s.marks.end(), into.marks.begin());
  std::copy(s.own.begin(), s.own.end(), into.own_marks.begin());
  std::copy(s.limited.begin(), s.limited.end(), into.limited.begin());
  std::copy(s.power.circuits().begin(), s.power.circuits().end(), into.circuits.begin());
  into.masters = s.masters;
  into.master_id = s.master_id;
  into.caution = s.caution;
  into.blackout = s.blackout;
  into.blackout_id = s.blackout_id;
  into.blind = s.blind || s.own_blind;
  into.motion_stop = {s.motion.stopped(), s.stop_id};
  into.motion_armed = {s.motion.armed(), s.arm_id};
  into.refused = s.watch.refused();
}

void Governor::carry_on(const Governor& before, std::span<const std::ptrdiff_t> from) {
  State& s = *state_;
  const State& old = *before.state_;
  for (std::size_t i = 0; i < s.lamps.size(); ++i) {
    if (i >= from.size() || from[i] < 0) continue;
    const auto j = static_cast<std::size_t>(from[i]);
    s.sources.carry(i, s.lamps[i], old.sources, j, old.lamps[j]);
    for (std::size_t d = 0; d < kDofs; ++d)
      if (const Dof dof = static_cast<Dof>(d); s.lamps[i].can(d) && old.lamps[j].can(d))
        s.lamps[i].base.set(dof, s.lamps[i].range[d].clamp(old.lamps[j].base.get(dof)));
    s.slewed[i] = old.slewed[j];
    s.levels.fixtures_[i] = old.levels.fixtures_[j];
    s.release_id[i] = old.release_id[j];
    s.brains[i] = old.brains[j];
    s.own[i] = old.own[j];
    s.parked[i] = old.parked[j];
    s.is_parked[i] = old.is_parked[j];
    s.waits_since[i] = old.waits_since[j];
  }
  s.sources.carry_fades(old.sources);
  s.watch.carry(old.watch);
  s.motion = old.motion;
  s.masters = old.masters;
  s.brain_masters = old.brain_masters;
  s.master_id = old.master_id;
  s.blackout = old.blackout;
  s.blackout_id = old.blackout_id;
  s.stop_id = old.stop_id;
  s.arm_id = old.arm_id;
  s.blind = old.blind;
  s.own_blind = old.own_blind;
  s.brain_was = old.brain_was;
  s.flash_until = old.flash_until;
  s.last_step = old.last_step;
  s.stepped = old.stepped;
  s.settle_marks();
  s.wake_all();
}

}  // namespace chiaro::rig
