// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/console.h"

#include <algorithm>

namespace chiaro::daemon {
namespace {

/// How fast a fader that is let go returns to the look.
constexpr double kReleaseFade = 0.5;

}  // namespace

bool set_by_hand(const studio::Fixture& fixture, core::Dof dof) {
  if (std::holds_alternative<studio::StandMount>(fixture.mount) && core::is_placement(dof) &&
      (dof == core::Dof::azimuth || dof == core::Dof::elevation || dof == core::Dof::distance))
    return true;
  return std::any_of(fixture.by_hand.begin(), fixture.by_hand.end(),
                     [&](const studio::HandBinding& binding) { return binding.dof == dof; });
}

Console::Console(const studio::Studio& studio) : fixtures_(studio.fixtures.size()) {
  for (rig::SourceState& state : wanted_.sources) state.fixtures.resize(fixtures_);
  wanted_.release_id.resize(fixtures_);
}

rig::SourceState& Console::source(rig::Source which) {
  return wanted_.sources[static_cast<std::size_t>(which)];
}

std::uint64_t Console::next_id(ports::TimePoint now) {
  const auto ns = static_cast<std::uint64_t>(now.time_since_epoch().count());
  return newest_id_ = std::max(ns, newest_id_ + 1);
}

void Console::adopt(const rig::Wanted& hand) {
  wanted_ = hand;
  for (rig::SourceState& state : wanted_.sources) {
    state.fixtures.resize(fixtures_);
    newest_id_ = std::max(newest_id_, state.fade_id);
  }
  newest_id_ = std::max({newest_id_, wanted_.blackout_id, wanted_.motion_stop.id});
  wanted_.release_id.assign(fixtures_, 0);
  for (const std::uint64_t id : wanted_.master_id) newest_id_ = std::max(newest_id_, id);
}

void Console::carry_to(const studio::Studio& before, const studio::Studio& after) {
  fixtures_ = after.fixtures.size();
  wanted_.tried = {};  // a slot that was nobody's may be somebody's now
  wanted_.release_id.assign(fixtures_, 0);
  for (rig::SourceState& state : wanted_.sources) {
    std::vector<core::FixtureState> carried(fixtures_);
    for (std::size_t i = 0; i < before.fixtures.size(); ++i)
      if (const auto to = after.fixture_index(before.fixtures[i].name))
        carried[*to] = state.fixtures[i];
    state.fixtures = std::move(carried);
  }
}

void Console::apply(const studio::Studio& studio, const studio::Rig& rig, double fade_s,
                    ports::TimePoint now) {
  const std::uint64_t id = next_id(now);
  rig::SourceState& look = source(rig::Source::look);
  rig::SourceState& manual = source(rig::Source::manual);
  look.fade_id = manual.fade_id = id;
  look.fade_s = manual.fade_s = fade_s;
  faded_ = now + std::chrono::duration_cast<ports::Duration>(std::chrono::duration<double>(fade_s));
  for (std::size_t i = 0; i < fixtures_; ++i) manual.fixtures[i] = {};
  set_look(studio, rig);
}

void Console::follow(const studio::Studio& studio, const studio::Rig& rig, double fade_s,
                     ports::TimePoint now) {
  rig::SourceState& look = source(rig::Source::look);
  look.fade_id = next_id(now);
  look.fade_s = fade_s;
  set_look(studio, rig);
}

void Console::set_look(const studio::Studio& studio, const studio::Rig& rig) {
  rig::SourceState& look = source(rig::Source::look);
  for (std::size_t i = 0; i < fixtures_; ++i) {
    look.fixtures[i] = {};
    const studio::Fixture& fixture = studio.fixtures[i];
    if (!fixture.controlled || i >= rig.states.size()) continue;
    for (const core::DofInfo& dof : core::dofs())
      if (rig.states[i].has(dof.dof) && !set_by_hand(fixture, dof.dof))
        look.fixtures[i].set(dof.dof, rig.states[i].get(dof.dof));
  }
}

void Console::hold(std::size_t fixture, const core::FixtureState& values, ports::TimePoint now) {
  rig::SourceState& manual = source(rig::Source::manual);
  manual.fixtures[fixture].overlay(values);
  manual.fade_id = next_id(now);
  manual.fade_s = 0;
}

void Console::release(std::size_t fixture, std::span<const core::Dof> dofs, ports::TimePoint now) {
  rig::SourceState& manual = source(rig::Source::manual);
  for (const core::Dof dof : dofs) manual.fixtures[fixture].clear(dof);
  manual.fade_id = next_id(now);
  manual.fade_s = kReleaseFade;
  wanted_.release_id[fixture] = manual.fade_id;  // and what a fader at the hand holds
}

void Console::set_master(std::size_t master, double level, ports::TimePoint now) {
  wanted_.masters[master] = level;
  wanted_.master_id[master] = next_id(now);
}

void Console::try_slots(std::span<const rig::TriedSlot> slots, ports::TimePoint until) {
  wanted_.tried = {};
  const std::size_t most = std::min(slots.size(), wanted_.tried.size());
  std::copy_n(slots.begin(), most, wanted_.tried.begin());
  wanted_.tried_until_ns = until.time_since_epoch().count();
}

std::uint64_t Console::blackout(bool on, ports::TimePoint now) {
  wanted_.blackout = on;
  return wanted_.blackout_id = next_id(now);
}

std::uint64_t Console::motion_stop(bool on, ports::TimePoint now) {
  wanted_.motion_stop = {on, next_id(now)};
  return wanted_.motion_stop.id;
}

const core::FixtureState& Console::held(std::size_t fixture) const {
  return wanted_.sources[static_cast<std::size_t>(rig::Source::manual)].fixtures[fixture];
}

bool Console::has_look() const {
  const auto& look = wanted_.sources[static_cast<std::size_t>(rig::Source::look)];
  return std::any_of(look.fixtures.begin(), look.fixtures.end(),
                     [](const core::FixtureState& state) { return state.present() != 0; });
}

}  // namespace chiaro::daemon
