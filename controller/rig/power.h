// SPDX-License-Identifier: Apache-2.0
// What the lamps behind one fuse may draw together. Where they are asked for more, all of them are
// held down by one factor of light, so that the picture keeps its ratios.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

/// A filament's power at a fraction of its light: light goes with the voltage's power of 3.4, power
/// with its power of 1.6 (the usual lamp rules), so half the light takes 72 %.
inline constexpr double kFilament = 1.6 / 3.4;

/// Real-time but for construction.
class PowerBudget {
 public:
  explicit PowerBudget(const studio::Studio& studio);
  /// The factor for each circuit if its lamps were sent `levels` (by fixture, linear light). Lamps
  /// that are `fixed` take what they take, and the others share the rest. True when a factor is
  /// another than before.
  bool weigh(std::span<const double> levels, std::span<const std::uint8_t> fixed);
  /// 1 for a lamp on no circuit.
  double scale_for(std::size_t fixture) const {
    const int c = circuit_of_[fixture];
    return c < 0 ? 1 : now_[static_cast<std::size_t>(c)].scale;
  }
  int circuit_of(std::size_t fixture) const { return circuit_of_[fixture]; }
  std::span<const Sent::Circuit> circuits() const { return now_; }

 private:
  struct Fuse {
    double limit = 0, law = 1;
    std::vector<studio::Circuit::Load> loads;
  };
  std::vector<Fuse> fuses_;
  std::vector<Sent::Circuit> now_;
  std::vector<int> circuit_of_;
};

}  // namespace chiaro::rig
