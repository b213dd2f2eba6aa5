// SPDX-License-Identifier: Apache-2.0
// The questions of `chiaro new` for a lamp that no profile describes: one slot after another goes
// up for a few seconds, and the person names what it did.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "controller/core/result.h"
#include "controller/daemon/interview/dialogue.h"
#include "controller/daemon/interview/learnt.h"

namespace chiaro::daemon::interview {

/// Shows a lamp some slots for a moment, then lets them fall: nothing stays raised while a person
/// thinks or walks away.
class Wire {
 public:
  virtual ~Wire() = default;
  /// Blocks for the moment. `interface` as the person named it.
  virtual core::Result<core::Done> show(const std::string& interface, std::uint16_t universe,
                                        const std::map<int, std::uint8_t>& slots) = 0;
};

struct Unknown {
  std::string name, interface;
  int universe = 1, address = 1, slots = 1;
};
/// Asks slot by slot. A wire that does not work is told once, and the questions go on: the person
/// may know the lamp.
LearntLamp learn(Dialogue& dialogue, Wire& wire, const Unknown& lamp);

}  // namespace chiaro::daemon::interview
