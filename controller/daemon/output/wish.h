// SPDX-License-Identifier: Apache-2.0
// What may be asked of the hand itself, brain or no brain.
#pragma once

#include <cstdint>

#include "controller/rig/wanted.h"

namespace chiaro::daemon {

struct Wish {
  enum class Kind : std::uint8_t {
    mark,
    motion_stop,
    motion_arm,
    cue_go,
    cue_back,
    cue_to,
    cue_off,
    level,    ///< a fader of a fixture's DOF; `number`: inside units
    release,  ///< lets the faders of a fixture go
    master,   ///< `number`: 0..1
    blind,
    ask,  ///< `fixture`: which of studio::asked_of_brain, `number`: how often
    home  ///< the fixture's motor looks for its home; only while motion is armed
  };
  static constexpr std::uint32_t kEvery = 0xffffffffu;  ///< as a fixture: each of them
  Kind kind = Kind::mark;
  bool on = false;
  rig::Mark mark = rig::Mark::highlight;
  std::uint32_t fixture = 0;  ///< index in the studio with this fingerprint; of another: dropped
  std::uint64_t studio = 0;
  double number = 0;  ///< of a cue; a level
  core::Dof dof = core::Dof::intensity;
  rig::Master master = rig::Master::grand;
};

}  // namespace chiaro::daemon
