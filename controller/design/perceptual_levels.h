// SPDX-License-Identifier: Apache-2.0
// Levels for goals on the six components. Histogram, edge share and contrast are no forms of the
// levels, so the mean's linear form starts and a pattern search in stops ends on the real measures.
#pragma once

#include "controller/design/levels.h"

namespace chiaro::design {

/// Levels in the given proportions, within bounds, whose picture has about that mean working scalar
/// over surface pixels.
std::vector<double> scaled_to_mean(const Columns& columns, const measure::PixelMap& map,
                                   std::span<const double> shares, double mean);

class PerceptualLevels : public LevelSolver {
 public:
  PerceptualLevels(const Target& target, const measure::PixelMap& map);
  Levels solve(const Columns& columns, Effort effort) override;
  double cost(const Columns& columns, std::span<const double> levels) override;

 private:
  std::vector<std::vector<double>> starts(const Columns& columns) const;
  bool improve(const Columns& columns, Levels& now, std::size_t k, double stops);

  const Target& target_;
  const measure::PixelMap& map_;
  core::Plane picture_;
};

}  // namespace chiaro::design
