// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/stage.h"

#include <cmath>
#include <variant>

namespace chiaro::simulator {
namespace {

using core::Dof;

core::FixtureState placement_of(const core::FixtureState& state) {
  core::FixtureState result;
  for (const auto& dof : core::dofs())
    if (core::is_placement(dof.dof) && state.has(dof.dof)) result.set(dof.dof, state.get(dof.dof));
  return result;
}

bool moved_by_hand(const studio::Fixture& fixture) {
  return std::holds_alternative<studio::StandMount>(fixture.mount);
}

}  // namespace

VirtualStage::VirtualStage(const studio::Studio& studio, const core::AimFrame& aim,
                           const Departures& departures, std::uint64_t seed)
    : studio_(studio), aim_(aim) {
  auto rig = studio::placed_rig(studio);
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    // A lamp on a wire that says nothing is dark.
    if (!std::holds_alternative<studio::NoPatch>(studio.fixtures[i].patch))
      rig.states[i].set(Dof::intensity, 0);
    lamps_.emplace_back(rig.states[i], character(departures, seed, i));
    put_.push_back(placement_of(rig.states[i]));
    lamps_[i].put(put_[i]);
  }
}

void VirtualStage::ask(const studio::Rig& rig) {
  for (std::size_t i = 0; i < lamps_.size() && i < rig.states.size(); ++i) {
    lamps_[i].ask(rig.states[i]);
    const auto placement = placement_of(rig.states[i]);
    if (!moved_by_hand(studio_.fixtures[i]) && placement.present() != 0) put(i, placement);
  }
}

void VirtualStage::put(std::size_t fixture, const core::FixtureState& placement) {
  put_.at(fixture).overlay(placement_of(placement));
  lamps_[fixture].put(put_[fixture]);
}

void VirtualStage::advance(double seconds) {
  for (auto& lamp : lamps_) lamp.advance(seconds);
}

std::vector<LitLamp> VirtualStage::lit() const {
  std::vector<LitLamp> result;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const auto state = lamps_[i].light();
    auto light = twin::light(studio_.fixtures[i], state, aim_, studio_.exposure.white_balance);
    light.fixture = i;
    const auto& own = lamps_[i].character();
    result.push_back({turned(light, own.aim_right, own.aim_up), state.get(Dof::intensity)});
  }
  return result;
}

studio::Rig VirtualStage::actual() const {
  studio::Rig rig;
  for (const auto& lamp : lamps_) rig.states.push_back(lamp.light());
  return rig;
}

twin::Light turned(twin::Light light, double right, double up) {
  if (right == 0 && up == 0) return light;
  const auto axis =
      core::unit(light.direction + std::tan(right) * light.right + std::tan(up) * light.up);
  const auto across = core::unit(light.right - core::dot(light.right, axis) * axis);
  light.up = core::unit(light.up - core::dot(light.up, axis) * axis -
                        core::dot(light.up, across) * across);
  light.right = across;
  light.direction = axis;
  return light;
}

}  // namespace chiaro::simulator
