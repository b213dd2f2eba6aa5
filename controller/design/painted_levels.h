// SPDX-License-Identifier: Apache-2.0
// Levels for a picture that a person painted over: weighted least squares in L*, each pixel for
// itself (Schoeneman, Dorsey, Smits, Arvo and Greenberg 1993, who solved in linear light). The
// linear solution starts, Gauss-Newton steps follow dL*/dY.
#pragma once

#include "controller/design/levels.h"

namespace chiaro::design {

/// Root of the weighted mean of squared differences from what was painted, in the working scalar.
double painted_distance(const Target& target, const core::Plane& luminance);

class PaintedLevels : public LevelSolver {
 public:
  /// Precondition: target.emphasis has the target's size.
  explicit PaintedLevels(const Target& target) : target_(target) {}
  Levels solve(const Columns& columns, Effort effort) override;
  double cost(const Columns& columns, std::span<const double> levels) override;

 private:
  bool step(const Columns& columns, Levels& now);

  const Target& target_;
  core::Plane picture_;
};

}  // namespace chiaro::design
