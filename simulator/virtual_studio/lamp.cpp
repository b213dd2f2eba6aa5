// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/lamp.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "controller/core/random.h"
#include "controller/core/units.h"

namespace chiaro::simulator {
namespace {

using core::Dof;

constexpr double kSteps = 4095;

struct Name {
  const char* name;
  bool Departures::*flag;
};
constexpr Name kNames[] = {
    {"output", &Departures::output}, {"colour", &Departures::colour},
    {"aim", &Departures::aim},       {"placement", &Departures::placement},
    {"curve", &Departures::curve},   {"lag", &Departures::lag},
    {"steps", &Departures::steps},
};

bool is_drive(Dof dof) { return dof == Dof::intensity || (dof >= Dof::red && dof <= Dof::cyan); }

}  // namespace

core::Result<Departures> departures_named(const std::string& words) {
  if (words == "on") return Departures{};
  if (words == "off") return Departures::none();
  Departures result = Departures::none();
  std::istringstream list(words);
  for (std::string word; std::getline(list, word, ',');) {
    const auto* found = std::find_if(std::begin(kNames), std::end(kNames),
                                     [&](const Name& name) { return word == name.name; });
    if (found == std::end(kNames))
      return core::Problem{{},
                           "'" + word + "' is not a departure of a lamp from its data sheet",
                           "use on, off, or some of "
                           "output,colour,aim,placement,curve,lag,steps"};
    result.*(found->flag) = true;
  }
  return result;
}

Character character(const Departures& departures, std::uint64_t seed, std::size_t fixture) {
  core::Random random(seed, fixture);
  // Every number is drawn whether it is used or not: switches must not shift the others.
  const auto draw = [&](bool wanted, double neutral, double most) {
    const double x = random.uniform(-most, most);
    return wanted ? neutral + x : neutral;
  };
  Character c;
  c.output = draw(departures.output, 1, 0.04);
  c.cct = draw(departures.colour, 1, 0.02);
  c.curve = draw(departures.curve, 1, 0.03);
  const double lag = random.uniform(0.03, 0.09);
  c.lag_s = departures.lag ? lag : 0;
  for (auto& emitter : c.emitters) emitter = draw(departures.colour, 1, 0.03);
  c.aim_right = draw(departures.aim, 0, core::radians(1.5));
  c.aim_up = draw(departures.aim, 0, core::radians(1.5));
  c.azimuth = draw(departures.placement, 0, core::radians(0.7));
  c.elevation = draw(departures.placement, 0, core::radians(0.7));
  c.distance = draw(departures.placement, 1, 0.01);
  c.steps = departures.steps;
  return c;
}

Lamp::Lamp(const core::FixtureState& initial, Character character)
    : character_(std::move(character)) {
  for (const auto& dof : core::dofs())
    if (!core::is_placement(dof.dof) && initial.has(dof.dof))
      asked_.set(dof.dof, initial.get(dof.dof));
  follows_ = asked_;
}

void Lamp::put(const core::FixtureState& placement) {
  placed_ = placement;
  const auto shift = [&](Dof dof, double factor, double by) {
    if (placed_.has(dof)) placed_.set(dof, placed_.get(dof) * factor + by);
  };
  shift(Dof::azimuth, 1, character_.azimuth);
  shift(Dof::elevation, 1, character_.elevation);
  shift(Dof::distance, character_.distance, 0);
}

void Lamp::advance(double seconds) {
  const double share = character_.lag_s > 0 ? 1 - std::exp(-seconds / character_.lag_s) : 1;
  for (const auto& dof : core::dofs()) {
    if (!asked_.has(dof.dof) || core::is_placement(dof.dof)) continue;
    const double from = follows_.get(dof.dof, asked_.get(dof.dof));
    follows_.set(dof.dof, from + share * (asked_.get(dof.dof) - from));
  }
}

core::FixtureState Lamp::light() const {
  core::FixtureState result = follows_;
  for (const auto& dof : core::dofs()) {
    if (!result.has(dof.dof) || !is_drive(dof.dof)) continue;
    double drive = std::clamp(result.get(dof.dof), 0.0, 1.0);
    if (character_.steps) drive = std::round(drive * kSteps) / kSteps;
    if (dof.dof == Dof::intensity)
      drive = std::pow(drive, character_.curve) * character_.output;
    else
      drive *= character_.emitters[core::index_of(dof.dof)];
    result.set(dof.dof, drive);
  }
  if (result.has(Dof::cct)) result.set(Dof::cct, result.get(Dof::cct) * character_.cct);
  result.overlay(placed_);
  return result;
}

}  // namespace chiaro::simulator
