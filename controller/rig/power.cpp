// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/power.h"

#include <algorithm>
#include <cmath>

namespace chiaro::rig {

PowerBudget::PowerBudget(const studio::Studio& studio)
    : now_(studio.circuits.size()), circuit_of_(studio.fixtures.size(), -1) {
  for (const studio::Circuit& circuit : studio.circuits) {
    for (const auto& load : circuit.loads)
      circuit_of_[load.fixture] = static_cast<int>(fuses_.size());
    fuses_.push_back({circuit.limit_w, circuit.tungsten ? kFilament : 1, circuit.loads});
  }
}

bool PowerBudget::weigh(std::span<const double> levels, std::span<const std::uint8_t> fixed) {
  bool changed = false;
  for (std::size_t c = 0; c < fuses_.size(); ++c) {
    const Fuse& fuse = fuses_[c];
    double asked = 0, taken = 0;
    for (const auto& load : fuse.loads)
      (fixed[load.fixture] != 0 ? taken : asked) +=
          load.watts * std::pow(std::clamp(levels[load.fixture], 0.0, 1.0), fuse.law);
    const double left = std::max(0.0, fuse.limit - taken);
    // All levels times k draw k^law of it.
    const double scale = asked > left ? std::pow(left / asked, 1 / fuse.law) : 1;
    changed |= scale != now_[c].scale;
    now_[c] = {taken + std::min(asked, left), scale};
  }
  return changed;
}

}  // namespace chiaro::rig
