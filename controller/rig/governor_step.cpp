// SPDX-License-Identifier: Apache-2.0
// One frame, from what the governor was told to what may be sent. Lamps that have arrived, and of
// which nothing new is wanted, are passed over: a hall of steady lamps costs next to nothing.
#include <algorithm>
#include <chrono>

#include "controller/rig/governor.h"
#include "controller/rig/governor_state.h"

namespace chiaro::rig {

using core::Dof;
using core::FixtureState;
using core::kDofs;
using ports::TimePoint;

namespace {

constexpr auto kIntensity = core::index_of(Dof::intensity);
/// A loop that was held up for longer must not make an axis lurch.
constexpr double kLongestStride = 0.1;

constexpr Limited operator|(Limited bits, Limit limit) {
  return static_cast<Limited>(bits | static_cast<Limited>(limit));
}

}  // namespace

/// What has changed for everybody since the last frame.
void Governor::State::look_around(TimePoint now, double elapsed) {
  caution = watch.judge(now, elapsed, blackout);
  const bool speaks = !watch.silent(now);
  const bool leased = now < flash_until;
  if (!leased)
    for (auto& mark : own) mark = static_cast<Marks>(mark & ~static_cast<Marks>(Mark::flash));
  if (speaks != brain_was || !leased) {
    brain_was = speaks;
    settle_marks();
  }
  if (watch.safe_progress() != used_safe || blackout != blackout_was || may_move() != could_move)
    wake_all();
  used_safe = watch.safe_progress();
  blackout_was = blackout;
  could_move = may_move();
}

/// Everything but the level as sent. True while it is on its way.
bool Governor::State::follow(std::size_t i, TimePoint now, double elapsed) {
  const Lamp& lamp = lamps[i];
  FixtureState& out = levels.fixtures_[i];
  Track& light = sources.track(i, kIntensity);
  const bool in_black = has(marks[i], Mark::move_in_black) && lamp.can(kIntensity);
  const bool dark = in_black && light.sent <= kDark;
  const bool going_dark = in_black && !dark && light.fade.target() <= kDark;
  bool busy = going_dark, there = true;
  limited[i] = 0;
  axes_waiting[i] = 0;
  for (std::size_t d = 0; d < kDofs; ++d) {
    if (!lamp.can(d) || d == kIntensity) continue;
    Track& t = sources.track(i, d);
    if (!lamp.is_axis(d) && t.fade.done(now) && t.sent == t.fade.target()) {
      out.set(static_cast<Dof>(d), t.sent);
      continue;
    }
    if (dark) t.fade.end();
    const double wanted = t.fade.at(now);
    if (!going_dark)
      busy |=
          lamp.is_axis(d) ? follow_axis(i, d, wanted, elapsed) : follow_light(i, d, wanted, now);
    busy |= !t.fade.done(now);
    there &= t.sent == t.fade.target();
    out.set(static_cast<Dof>(d), t.sent);
  }
  if (!lamp.can(kIntensity)) return busy;
  if (in_black && wait_in_the_dark(i, there, now)) return true;
  busy |= follow_light(i, kIntensity, light.fade.at(now), now) || !light.fade.done(now);
  return busy;
}

bool Governor::State::follow_axis(std::size_t i, std::size_t d, double wanted, double elapsed) {
  Track& t = sources.track(i, d);
  if (t.sent == wanted) return false;
  if (!may_move() || is_parked[i] != 0) {  // nothing to do until that changes
    limited[i] = limited[i] | Limit::motion;
    ++axes_waiting[i];
    return false;
  }
  const double reach = lamps[i].speed[d] * std::min(elapsed, kLongestStride);
  const double next = t.sent + std::clamp(wanted - t.sent, -reach, reach);
  FixtureState here, there;  // an arc and a track have this one axis
  here.set(static_cast<Dof>(d), t.sent);
  there.set(static_cast<Dof>(d), next);
  if (keep_out.may_go(i, here, there)) {
    t.sent = next;
  } else {
    limited[i] = limited[i] | Limit::person;
    ++axes_waiting[i];
  }
  return true;
}

bool Governor::State::follow_light(std::size_t i, std::size_t d, double wanted, TimePoint now) {
  Track& t = sources.track(i, d);
  if (t.winner >= static_cast<int>(Source::manual)) {  // a person's hand
    t.sent = wanted;
    t.guard.follow(t.sent);
    return false;
  }
  t.sent = is_light(static_cast<Dof>(d)) ? t.guard.allow(wanted, now) : wanted;
  if (t.sent == wanted) return false;
  limited[i] = limited[i] | Limit::flash;
  return true;
}

/// A lamp that moves in black and is to be lit stays dark until everything else has arrived; then
/// its fade begins.
bool Governor::State::wait_in_the_dark(std::size_t i, bool there, TimePoint now) {
  Track& light = sources.track(i, kIntensity);
  const bool waited = waits_since[i] != TimePoint{};
  if (light.sent <= kDark && light.fade.target() > kDark && !there) {
    if (!waited) waits_since[i] = now;
    if (now - waits_since[i] < kMostWait) return true;
  }
  if (waited) light.fade.start(light.sent, light.fade.target(), now, light.fade.seconds());
  waits_since[i] = {};
  return false;
}

double Governor::State::master(const Lamp& lamp) const {
  const double grand = masters[static_cast<std::size_t>(Master::grand)];
  return lamp.master ? grand * masters[static_cast<std::size_t>(*lamp.master)] : grand;
}

double Governor::State::marked_and_mastered(std::size_t i) const {
  const Lamp& lamp = lamps[i];
  double level = sources.track(i, kIntensity).sent;
  if (any_solo && !has(marks[i], Mark::solo) && !lamp.ignores_blackout) level = 0;
  if (has(marks[i], Mark::flash)) level = 1;
  level *= master(lamp);
  if (has(marks[i], Mark::highlight)) level = 1;
  return blend(Dof::intensity, level, lamp.safe, watch.safe_progress());
}

/// Nothing passes `most` or outruns the slew limit; the first frame starts where it is told. True
/// while it is on its way.
bool Governor::State::limit(std::size_t i, double wanted, double elapsed) {
  const Lamp& lamp = lamps[i];
  const double level = lamp.range[kIntensity].clamp(wanted);
  if (level < wanted) limited[i] = limited[i] | Limit::most;
  const double reach = lamp.slew_per_s * elapsed;
  if (lamp.slew_per_s <= 0 || !stepped) {
    slewed[i] = level;
  } else {
    slewed[i] += std::clamp(level - slewed[i], -reach, reach);
    if (slewed[i] != level) limited[i] = limited[i] | Limit::slew;
  }
  return slewed[i] != level;
}

void Governor::State::open_white(std::size_t i) {
  FixtureState& out = levels.fixtures_[i];
  for (std::size_t d = 0; d < kDofs; ++d) {
    const Dof dof = static_cast<Dof>(d);
    if (!lamps[i].can(d) || d == kIntensity) continue;
    if (is_light(dof)) out.set(dof, lamps[i].range[d].most);
    if (dof == Dof::tint) out.set(dof, lamps[i].range[d].clamp(0));
  }
}

/// What the lamp's circuit must bear: nothing in a blackout; what it is parked at, or has not come
/// down from yet, whatever the circuit says; else what is asked of it.
void Governor::State::weigh(std::size_t i) {
  const core::Range range = lamps[i].range[kIntensity];
  draws[i] = 0;
  bound[i] = 1;
  if (!lamps[i].can(kIntensity) || (blackout && !lamps[i].ignores_blackout)) return;
  draws[i] = is_parked[i] != 0 ? range.clamp(parked[i].get(Dof::intensity)) : slewed[i];
  if (is_parked[i] != 0) return;
  const double target = range.clamp(asked[i] * power.scale_for(i));
  if (lamps[i].slew_per_s > 0 && stepped && slewed[i] > target) return;
  draws[i] = range.clamp(asked[i]);
  bound[i] = 0;
}

/// From the level asked for to what leaves. True while it is on its way.
bool Governor::State::finish(std::size_t i, double elapsed) {
  const Lamp& lamp = lamps[i];
  if (!lamp.can(kIntensity)) return false;
  FixtureState& out = levels.fixtures_[i];
  constexpr auto kFollowed =
      static_cast<Limited>(Limited{} | Limit::flash | Limit::motion | Limit::person);
  limited[i] = static_cast<Limited>(limited[i] & kFollowed);
  const double scale = is_parked[i] != 0 ? 1 : power.scale_for(i);
  if (scale < 1) limited[i] = limited[i] | Limit::power;
  const double wanted = asked[i] * scale;
  const bool busy = limit(i, wanted, elapsed);
  // A new fade starts from what is really sent, where only limits have come between.
  const double m = master(lamp);
  constexpr auto kOverriding = static_cast<Marks>(Mark::highlight) |
                               static_cast<Marks>(Mark::flash) | static_cast<Marks>(Mark::solo);
  if (slewed[i] != wanted && m > 0 && scale >= 1 && used_safe <= 0 && !any_solo &&
      (marks[i] & kOverriding) == 0)
    sources.track(i, kIntensity).sent = std::clamp(slewed[i] / m, 0.0, 1.0);
  double level = slewed[i];
  if (has(marks[i], Mark::highlight)) open_white(i);
  if (is_parked[i] != 0) {
    out.overlay(parked[i]);
    level = lamp.range[kIntensity].clamp(parked[i].get(Dof::intensity));
  }
  out.set(Dof::intensity, blackout && !lamp.ignores_blackout ? 0 : level);
  return busy;
}

const AllowedLevels& Governor::step(TimePoint now) {
  State& s = *state_;
  const double elapsed = std::chrono::duration<double>(now - s.last_step).count();
  s.look_around(now, elapsed);
  std::vector<std::uint8_t>& awake = s.woken;
  constexpr std::uint8_t kAwake = 1, kBusy = 2;
  for (std::size_t i = 0; i < s.lamps.size(); ++i) {
    if (awake[i] == 0) continue;
    if (s.follow(i, now, elapsed)) awake[i] |= kBusy;
    s.asked[i] = s.marked_and_mastered(i);
    s.weigh(i);
  }
  if (s.power.weigh(s.draws, s.bound))
    for (auto& each : awake) each |= kAwake;
  s.levels.changed_.clear();
  for (std::size_t i = 0; i < s.lamps.size(); ++i) {
    if (awake[i] == 0) continue;
    if (s.finish(i, elapsed)) awake[i] |= kBusy;
    s.levels.changed_.push_back(static_cast<std::uint32_t>(i));
    awake[i] = (awake[i] & kBusy) != 0 ? kAwake : std::uint8_t{0};
  }
  s.last_step = now;
  s.stepped = true;
  return s.levels;
}

}  // namespace chiaro::rig
