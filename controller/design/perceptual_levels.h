// SPDX-License-Identifier: Apache-2.0
// Levels for goals on the six components. Histogram, edge share and contrast are no forms of the
// levels, so the mean's linear form starts and a pattern search in stops ends on the real measures.
// Each step changes one lamp in the picture; a quick solve of many lamps steps those that give
// most.
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
  std::vector<std::vector<double>> starts(const Columns& columns, Effort effort) const;
  bool improve(const Columns& columns, Levels& now, std::size_t k, double stops);
  double cost_of(const core::Plane& picture, const Columns& columns) const;

  const Target& target_;
  const measure::PixelMap& map_;
  core::Plane picture_;        ///< of the levels that `improve` starts from
  core::Plane changed_;        ///< with one level changed
  std::vector<double> given_;  ///< light of each lamp at full over the surface pixels
};

}  // namespace chiaro::design
