// SPDX-License-Identifier: Apache-2.0
// What the governor is told.
#include "controller/rig/governor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "controller/rig/governor_state.h"

namespace chiaro::rig {

using core::FixtureState;
using ports::TimePoint;

namespace {

double tidy_master(double level) { return std::isfinite(level) ? std::clamp(level, 0.0, 1.0) : 1; }

}  // namespace

Governor::State::State(const studio::Studio& studio, TimePoint now)
    : fingerprint(studio.fingerprint),
      watch(studio.safety, now),
      power(studio),
      keep_out(studio),
      levels(studio.fixtures.size()),
      last_step(now) {
  brain_masters.fill(std::numeric_limits<double>::quiet_NaN());
}

void Governor::State::add(const Lamp& lamp, const FixtureState* held) {
  lamps.push_back(lamp);
  FixtureState& base = lamps.back().base;
  if (held != nullptr)
    for (std::size_t d = 0; d < core::kDofs; ++d)
      if (const auto dof = static_cast<core::Dof>(d); lamp.can(d) && held->has(dof))
        base.set(dof, lamp.range[d].clamp(held->get(dof)));
  sources.add(lamps.back(), held);
  release_id.push_back(0);
  brains.push_back(0);
  own.push_back(0);
  marks.push_back(0);
  asked.push_back(0);
  draws.push_back(0);
  bound.push_back(0);
  slewed.push_back(0);  // set by the first step
  parked.emplace_back();
  is_parked.push_back(0);
  woken.push_back(1);
  waits_since.emplace_back();
  limited.push_back(0);
  axes_waiting.push_back(0);
}

Governor::Governor(const studio::Studio& studio, TimePoint now, const Held* held)
    : state_(std::make_unique<State>(studio, now)) {
  State& s = *state_;
  const studio::Rig placed = studio::placed_rig(studio);
  const bool dark = studio.safety.power_up == studio::Safety::PowerUp::dark;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const FixtureState known = i < placed.states.size() ? placed.states[i] : FixtureState{};
    FixtureState before;
    if (held != nullptr && i < held->fixtures.size()) before = held->fixtures[i];
    if (dark) before.clear(core::Dof::intensity);  // axes stay where they are all the same
    s.add(lamp_of(studio.fixtures[i], known, dark), &before);
  }
  if (held != nullptr) s.recall(*held, dark);
}

void Governor::State::recall(const Held& held, bool dark) {
  blackout = held.blackout;  // latched until somebody releases it, power cut or not
  motion.stop(held.motion_stop);
  recall_marks(held);
  sources.remember(held.fade_id);
  master_id = held.master_id;
  blackout_id = held.blackout_id;
  stop_id = held.stop_id;
  arm_id = held.arm_id;
  if (dark) return;
  recalled = true;
  for (std::size_t m = 0; m < kMasters; ++m) masters[m] = tidy_master(held.masters[m]);
  for (std::size_t i = 0; i < lamps.size() && i < held.own.size(); ++i)
    sources.recall_own(i, lamps[i], held.own[i]);
}

Governor::~Governor() = default;
Governor::Governor(Governor&&) noexcept = default;
Governor& Governor::operator=(Governor&&) noexcept = default;

void Governor::State::hear_latches(const Wanted& wanted) {
  if (wanted.blackout_id != blackout_id) {
    blackout_id = wanted.blackout_id;
    blackout = wanted.blackout;
  }
  if (wanted.motion_stop.id != stop_id) {
    stop_id = wanted.motion_stop.id;
    motion.stop(wanted.motion_stop.on);
  }
}

/// A master that the brain has a new wish for; what it said before, or said to the hand that ran
/// before a power cut, does not undo what was done at the hand since.
void Governor::State::hear_masters(const Wanted& wanted) {
  for (std::size_t m = 0; m < kMasters; ++m) {
    const double level = tidy_master(wanted.masters[m]);
    const bool first = std::isnan(brain_masters[m]);
    const bool fresh = wanted.master_id[m] != master_id[m] || (first && !recalled);
    if (fresh || (!first && level != brain_masters[m])) set_master(m, level);
    brain_masters[m] = level;
    master_id[m] = wanted.master_id[m];
  }
}

void Governor::State::hear_releases(const Wanted& wanted, TimePoint now) {
  for (std::size_t i = 0; i < release_id.size() && i < wanted.release_id.size(); ++i) {
    const std::uint64_t id = std::exchange(release_id[i], wanted.release_id[i]);
    if (id != release_id[i] && heard_releases)
      sources.release_own(i, lamps, kReleaseFade, now, woken);
  }
  heard_releases = true;
}

void Governor::State::set_master(std::size_t master, double level) {
  if (level != masters[master]) wake_all();
  masters[master] = level;
}

void Governor::take(const Wanted& wanted, TimePoint now) {
  State& s = *state_;
  const TimePoint posted{std::chrono::nanoseconds(wanted.posted_ns)};
  if (posted > now + std::chrono::seconds(1)) return;  // left over from before a reboot
  s.hear_latches(wanted);
  s.watch.refuse(wanted.studio_fingerprint != s.fingerprint);
  if (s.watch.refused()) return;
  s.watch.heard(posted, now);
  if (wanted.motion_armed.id != s.arm_id) {
    s.arm_id = wanted.motion_armed.id;
    s.motion.arm(wanted.motion_armed.on);
  }
  s.hear_masters(wanted);
  for (std::size_t i = 0; i < s.brains.size(); ++i)
    s.brains[i] = i < wanted.marks.size() ? wanted.marks[i] : Marks{0};
  s.settle_marks();
  s.blind = wanted.blind;
  s.hear_releases(wanted, now);
  if (!s.blind && !s.own_blind) s.sources.hear(s.lamps, wanted.sources, now, s.woken);
}

void Governor::refuse() { state_->watch.refuse(true); }
void Governor::set_blackout(bool on) { state_->blackout = on; }
bool Governor::blackout() const { return state_->blackout; }
void Governor::stop_motion(bool on) { state_->motion.stop(on); }
void Governor::arm_motion(bool on) { state_->motion.arm(on); }
bool Governor::motion_stopped() const { return state_->motion.stopped(); }
bool Governor::motion_armed() const { return state_->motion.armed(); }
Caution Governor::caution() const { return state_->caution; }
void Governor::stand_on(const SourceState& cue) { state_->sources.stand_on(state_->lamps, cue); }
bool Governor::cue_plays() const { return state_->sources.has_cue(); }

void Governor::set_blind(bool on) { state_->own_blind = on; }

void Governor::set_master(Master master, double level) {
  if (std::isfinite(level))
    state_->set_master(static_cast<std::size_t>(master), tidy_master(level));
}

void Governor::set_level(std::size_t fixture, core::Dof dof, double value, TimePoint now) {
  State& s = *state_;
  if (fixture < s.lamps.size()) s.sources.hear_own(fixture, s.lamps, dof, value, now, s.woken);
}

void Governor::release(std::size_t fixture, TimePoint now) {
  State& s = *state_;
  if (fixture < s.lamps.size()) s.sources.release_own(fixture, s.lamps, kReleaseFade, now, s.woken);
}

void Governor::mark(std::size_t fixture, Mark mark, bool on, TimePoint now) {
  State& s = *state_;
  if (fixture >= s.own.size()) return;
  const auto bit = static_cast<Marks>(mark);
  s.own[fixture] = static_cast<Marks>(on ? s.own[fixture] | bit : s.own[fixture] & ~bit);
  if (mark == Mark::flash && on) s.flash_until = now + kFlashLease;
  s.settle_marks();
}

void Governor::play(const SourceState& cue, const SourceState& ahead, TimePoint now) {
  State& s = *state_;
  s.sources.hear_cue(s.lamps, cue, ahead, s.marks, now, s.woken);
}

/// What was marked before a power cut, a parked lamp at the level that it was parked at. The
/// brain's marks stand until it speaks.
void Governor::State::recall_marks(const Held& held) {
  constexpr auto kLasting = static_cast<Marks>(~static_cast<Marks>(Mark::flash));
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (i < held.own_marks.size()) own[i] = held.own_marks[i] & kLasting;
    if (i < held.marks.size()) brains[i] = held.marks[i] & kLasting;
    if (i >= held.marks.size() || !has(held.marks[i], Mark::park)) continue;
    parked[i] = lamps[i].base;
    is_parked[i] = 1;
  }
  settle_marks();
}

/// Both sides' marks as one, and what was parked just now stays as it is being sent.
void Governor::State::settle_marks() {
  const bool solo_before = any_solo;
  any_solo = false;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const auto heard = brain_was ? brains[i] : brains[i] & ~static_cast<Marks>(Mark::flash);
    const auto both = static_cast<Marks>(heard | own[i]);
    any_solo |= has(both, Mark::solo);
    if (both == marks[i]) continue;
    marks[i] = both;
    woken[i] = 1;
    if (has(both, Mark::park) && is_parked[i] == 0 && stepped) {
      parked[i] = levels.fixtures_[i];
      parked[i].set(core::Dof::intensity, slewed[i]);
      is_parked[i] = 1;
    }
    if (!has(both, Mark::park)) is_parked[i] = 0;
  }
  if (any_solo != solo_before) wake_all();
}

}  // namespace chiaro::rig
