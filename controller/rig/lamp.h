// SPDX-License-Identifier: Apache-2.0
// What is fixed about one lamp, as the governor needs it: the studio's words in plain numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "controller/core/dof.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

struct Lamp {
  std::uint32_t has = 0;   ///< bit per DOF
  std::uint32_t axes = 0;  ///< bit per DOF that a motor moves through the room or about a yoke
  std::array<core::Range, core::kDofs> range{};
  std::array<double, core::kDofs> speed{};  ///< of axes: inside units per second
  double slew_per_s = 0, safe = 0;
  bool ignores_blackout = false;
  std::optional<Master> master;  ///< beside the grand master
  core::FixtureState base;       ///< when nobody has an opinion

  bool can(std::size_t d) const { return (has >> d & 1u) != 0; }
  bool is_axis(std::size_t d) const { return (axes >> d & 1u) != 0; }
};

/// `placed`: the lamp as the studio file has it. `dark`: it starts at its safe level.
Lamp lamp_of(const studio::Fixture& fixture, const core::FixtureState& placed, bool dark);

}  // namespace chiaro::rig
