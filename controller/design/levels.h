// SPDX-License-Identifier: Apache-2.0
// Levels are solved, not searched: for lamps that stand still the picture is linear in the levels,
// so the best levels cost microseconds and the outer search runs over positions only.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "controller/core/picture.h"
#include "controller/core/units.h"
#include "controller/design/target.h"
#include "controller/measure/measure.h"

namespace chiaro::design {

/// What levels mix: picture = offset + sum level_k * planes[k], display-linear luminance. Borrowed.
struct Columns {
  std::vector<const core::Plane*> planes;
  const core::Plane* offset = nullptr;
  const core::Plane* lit = nullptr;  ///< what the key sees, 0..1; null: nothing is in shadow
  std::vector<core::Range> bounds;
};

struct Levels {
  std::vector<double> values;
  double cost = 0;
};

/// quick: inside a trial. thorough: once per look, a few times the work.
enum class Effort { quick, thorough };

/// Holds scratch memory: one per thread. The answer depends on the arguments only.
class LevelSolver {
 public:
  virtual ~LevelSolver() = default;
  virtual Levels solve(const Columns& columns, Effort effort) = 0;
  /// The cost of given levels; what solve() minimises.
  virtual double cost(const Columns& columns, std::span<const double> levels) = 0;
};

/// `target` and `map` must outlive the solver; `map` is of the target's size.
std::unique_ptr<LevelSolver> level_solver(const Target& target, const measure::PixelMap& map);

/// out = offset + sum level_k * planes[k].
void mix(const Columns& columns, std::span<const double> levels, core::Plane& out);

}  // namespace chiaro::design
