// SPDX-License-Identifier: Apache-2.0
// Levels by example, wavelet: the linear Gram solution starts, then Gauss-Newton steps on L* of the
// clipped picture, each a small bounded least-squares problem over layers weighted by dL*/dY.
#pragma once

#include "controller/design/levels.h"

namespace chiaro::design {

class WaveletLevels : public LevelSolver {
 public:
  explicit WaveletLevels(const Target& target);
  Levels solve(const Columns& columns, Effort effort) override;
  double cost(const Columns& columns, std::span<const double> levels) override;

 private:
  std::vector<double> linear_solution(const Columns& columns) const;
  /// One step from `now`, along the bounded least-squares answer of the linearised problem, halved
  /// until the cost falls. False when it does not.
  bool step(const Columns& columns, Levels& now);
  /// Differences to the target in L*, and dL*/dY where a change of light would show.
  void linearise(const Columns& columns, std::span<const double> levels);

  const Target& target_;
  core::Plane picture_, difference_, slope_, rest_, nothing_;
  core::Plane ceiling_;  ///< where the exemplar clipped: from here on nothing costs
  std::vector<core::Plane> weighted_;
  measure::HaarSpectrum zero_;
};

}  // namespace chiaro::design
