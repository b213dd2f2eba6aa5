// SPDX-License-Identifier: Apache-2.0
// Levels are solved, not searched: for lamps that stand still the picture is linear in the levels,
// so the best levels cost microseconds and the outer search runs over positions only.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "controller/core/picture.h"
#include "controller/core/units.h"
#include "controller/design/target.h"
#include "controller/measure/measure.h"

namespace chiaro::design {

/// least <= constant + sum level_k * per_level[k] <= most: what must hold.
struct LinearBound {
  std::vector<double> per_level;
  double constant = 0, least = 0, most = 0;
  bool holds(double value) const {
    const double slack = 1e-3 * std::abs(std::isfinite(most) ? most : least);
    return value >= least - slack && value <= most + slack;
  }
};

/// How much of the light that lamps would throw on a region is hidden from it.
struct ShadowShare {
  std::vector<double> light, hidden;  ///< per level, lux
  double constant = 0, hidden_constant = 0;
  double weight = 1;
  bool wanted = false;  ///< else it costs
  double share(std::span<const double> levels) const;
};

/// A highlight that is wished of a lamp: a dark one makes none.
struct Highlight {
  std::optional<std::size_t> level;  ///< which; nothing: the lamp is held
  bool lit = false;                  ///< a held lamp
  double weight = 1, off = 0;        ///< 0: it stands where it is wished, 1: a quarter turn away
  double cost(std::span<const double> levels) const {
    return weight * ((level ? levels[*level] > 1e-3 : lit) ? off : 1);
  }
};

/// What levels mix: picture = offset + sum level_k * planes[k], display-linear luminance. Borrowed.
struct Columns {
  std::vector<const core::Plane*> planes;
  const core::Plane* offset = nullptr;
  const core::Plane* lit = nullptr;  ///< what the key sees, 0..1; null: nothing is in shadow
  std::vector<core::Range> bounds;
  std::vector<LinearBound> linear;        ///< asked beside the goal
  std::vector<ShadowShare> shadows;       ///< wished away, or wished
  std::vector<const Columns*> elsewhere;  ///< what other cameras see of the same lamps
  std::vector<double> key_lux, fill_lux;  ///< at the face, per level; empty: no term asks
  std::vector<Highlight> highlights;      ///< wished
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
