// SPDX-License-Identifier: Apache-2.0
// Levels for a goal with wishes and bounds beside it: the goal's own solver starts, then levels are
// stepped in stops on both together, each try laid back on what the bounds allow.
#pragma once

#include "controller/design/asked.h"
#include "controller/design/levels.h"

namespace chiaro::design {

/// `levels` moved as little as need be so that every bound holds (cyclic projections); the answer
/// is how far the worst is missed, as a share of its limit: 0 when all hold.
double lay_on_bounds(const Columns& columns, std::vector<double>& levels);

class AskedLevels : public LevelSolver {
 public:
  AskedLevels(std::unique_ptr<LevelSolver> goal, const Target& target,
              const measure::PixelMap& map);
  Levels solve(const Columns& columns, Effort effort) override;
  double cost(const Columns& columns, std::span<const double> levels) override;

 private:
  double scale(const Columns& columns);
  bool improve(const Columns& columns, Levels& now, std::size_t k, double stops);
  /// Costs levels as they are laid on the bounds; keeps them if they are better.
  bool tried(const Columns& columns, std::vector<double> levels, Levels& best);

  const std::unique_ptr<LevelSolver> goal_;
  const Target& target_;
  const measure::PixelMap& map_;
  core::Plane picture_;
  std::vector<std::unique_ptr<LevelSolver>> sides_;  ///< other cameras'
};

}  // namespace chiaro::design
