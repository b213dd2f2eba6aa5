// SPDX-License-Identifier: Apache-2.0
// A lamp that is not quite what its data sheet says: it lags, its dimmer bends, its driver has
// steps, and its output, colour and aim are a little off. The design engine knows none of this:
// that is what makes the virtual studio a test of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/result.h"

namespace chiaro::simulator {

/// Which departures from the data sheet the lamps and their stands have.
struct Departures {
  bool output = true;     ///< full output off by up to 4 %
  bool colour = true;     ///< CCT off by up to 2 %, each coloured emitter by up to 3 %
  bool aim = true;        ///< axis off by up to 1.5 degrees
  bool placement = true;  ///< stands off by up to 0.7 degrees and 1 % of their distance
  bool curve = true;      ///< light = wanted^x, x within 3 % of 1
  bool lag = true;        ///< first-order, 30 to 90 ms
  bool steps = true;      ///< drivers of 12 bits
  static Departures none() { return {false, false, false, false, false, false, false}; }
  friend bool operator==(const Departures&, const Departures&) = default;
};
/// "on", "off", or some of "output,colour,aim,placement,curve,lag,steps".
core::Result<Departures> departures_named(const std::string& words);

/// One lamp's own numbers. The same seed and fixture index give the same lamp, and switching one
/// departure off leaves the others as they were.
struct Character {
  double output = 1, cct = 1, curve = 1, lag_s = 0;
  std::vector<double> emitters = std::vector<double>(core::kDofs, 1.0);  ///< factor by DOF
  double aim_right = 0, aim_up = 0;                                      ///< radians
  bool steps = false;
  double azimuth = 0, elevation = 0, distance = 1;  ///< placement: added, added, factor
};
Character character(const Departures& departures, std::uint64_t seed, std::size_t fixture);

/// Lighting units: fractions of the data sheet's full output. One thread at a time.
class Lamp {
 public:
  /// `initial`: what it does until it is asked for anything.
  Lamp(const core::FixtureState& initial, Character character);

  /// What the wire asks for; DOFs that it does not name stay as they are.
  void ask(const core::FixtureState& state) { asked_.overlay(state); }
  /// A person has put its stand there: where it now really is.
  void put(const core::FixtureState& placement);
  /// Follows what is asked for during that time.
  void advance(double seconds);

  /// What it does now, as a perfect lamp would have to be told to do it: intensity may pass 1.
  core::FixtureState light() const;
  /// As light(), with the placement.
  const core::FixtureState& placed() const { return placed_; }
  const Character& character() const { return character_; }

 private:
  Character character_;
  core::FixtureState asked_, follows_, placed_;
};

}  // namespace chiaro::simulator
