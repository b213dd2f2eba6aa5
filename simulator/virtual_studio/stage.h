// SPDX-License-Identifier: Apache-2.0
// All lamps of the virtual studio with their stands: what the wire asks for goes in, the light that
// really falls comes out.
#pragma once

#include <cstdint>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/studio/studio.h"
#include "controller/twin/scene.h"
#include "simulator/virtual_studio/lamp.h"

namespace chiaro::simulator {

/// One lamp as it shines now: the light at full level in its present colour, and the level.
struct LitLamp {
  twin::Light light;
  double level = 0;
};

/// One thread at a time; borrows the studio.
class VirtualStage {
 public:
  VirtualStage(const studio::Studio& studio, const core::AimFrame& aim,
               const Departures& departures, std::uint64_t seed);

  /// The levels and colours that the wire asks for, by fixture. Placement in them is for motorised
  /// mounts; stands only move by put().
  void ask(const studio::Rig& rig);
  /// Somebody puts the stand of a fixture there; DOFs that are absent stay.
  void put(std::size_t fixture, const core::FixtureState& placement);
  void advance(double seconds);

  std::vector<LitLamp> lit() const;
  /// What each lamp really does and where it really stands.
  studio::Rig actual() const;

 private:
  const studio::Studio& studio_;
  core::AimFrame aim_;
  std::vector<core::FixtureState> put_;  ///< where the stands were meant to go
  std::vector<Lamp> lamps_;
};

/// The light with its axis turned towards its own right and up, radians.
twin::Light turned(twin::Light light, double right, double up);

}  // namespace chiaro::simulator
