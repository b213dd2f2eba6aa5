// SPDX-License-Identifier: Apache-2.0
// What a design may change: which lamps may move, and which may change their level. The point that
// an optimiser sees holds placements only, because levels are solved inside each trial.
#pragma once

#include <span>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/units.h"
#include "controller/design/design.h"
#include "controller/optimise/optimiser.h"

namespace chiaro::design {

struct Variable {
  std::size_t fixture = 0;
  core::Dof dof = core::Dof::azimuth;
  core::Range range;  ///< inside units, width > 0
};

struct Variables {
  studio::Rig base;                 ///< everything that is not a variable
  std::vector<Variable> moving;     ///< stands, virtual mounts and motors
  std::vector<std::size_t> lit;     ///< fixtures whose level is solved, ascending
  std::vector<std::size_t> held;    ///< fixtures that stay as `base` has them, ascending
  std::vector<core::Range> limits;  ///< of the level, beside `lit`
  bool glasses = false;             ///< the sitter wears them

  std::vector<core::Range> bounds() const;
  /// `base` with the placements of a point.
  studio::Rig rig(std::span<const double> point) const;
  /// The placements of a rig, clamped into the bounds.
  optimise::Point point(const studio::Rig& rig) const;
  /// Fixtures that move, ascending, each once.
  std::vector<std::size_t> movers() const;
};

/// Points that differ from `from` only in where `fixture` stands: a lattice over its region's
/// azimuths and elevations. `from` itself when it does not move.
std::vector<optimise::Point> lattice(const Variables& variables, std::size_t fixture,
                                     const optimise::Point& from);

/// The region of a stand or a virtual mount; null for mounts that the search does not move.
const studio::Region* region_of(const studio::Fixture& fixture);

/// Locked fixtures and uncontrolled practicals keep their state: the one of `options.start` when
/// given, else as placed. Placements of the others start from `options.start` too.
Variables variables_of(const studio::Studio& studio, const Options& options);

/// A wrong name in `options.locked` or `options.optimiser`, sizes of 0, a start of another studio.
core::Problems problems_of(const studio::Studio& studio, const Options& options);

}  // namespace chiaro::design
