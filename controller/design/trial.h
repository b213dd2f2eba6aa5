// SPDX-License-Identifier: Apache-2.0
// One trial: put the lamps somewhere, solve their levels, score the picture. A lamp that has not
// moved since this workspace's last trial keeps its layer.
#pragma once

#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "controller/design/layers.h"
#include "controller/design/levels.h"
#include "controller/design/target.h"
#include "controller/design/variables.h"

namespace chiaro::design {

class AskedOfPlaces;  // asked.h

/// What every trial of one stage shares; all borrowed, constant while trials run.
struct Setting {
  const studio::Studio& studio;
  const Layers& layers;
  const Variables& variables;
  const Target& target;
  const measure::PixelMap& map;
  Accuracy accuracy = Accuracy::cached;
};

/// The lamp whose cast shadows count as "shadow": the first key; nothing when there is none [I-9].
std::optional<std::size_t> key_of(const studio::Studio& studio);
/// The view's pixel types where the target's components look at geometry, else every pixel alike.
measure::PixelMap map_for(const Layers& layers, const Target& target);

class Workspace {
 public:
  explicit Workspace(const Setting& setting);
  ~Workspace();

  struct Scored {
    double cost = std::numeric_limits<double>::infinity();  ///< +infinity: a lamp must not be there
    std::vector<double> levels;                             ///< beside Variables::lit
  };
  /// Levels solved for the rig's placements and colours; its own levels are ignored.
  Scored solve(const studio::Rig& rig, Effort effort);
  /// The rig with its own levels, as the reference path tries it.
  Scored score(const studio::Rig& rig);

  /// Layers for the rig, fetched where something but the level changed.
  const Columns& columns(const studio::Rig& rig);
  LevelSolver& solver() { return *solver_; }

 private:
  void fetch(const studio::Rig& rig, std::size_t fixture, core::Plane& plane,
             core::FixtureState& known);
  void fetch_offset(const studio::Rig& rig);
  void fetch_shadows(const studio::Rig& rig);
  bool feasible(const studio::Rig& rig) const;

  const Setting setting_;
  std::vector<std::size_t> movers_;
  std::vector<core::Plane> planes_;        ///< beside Variables::lit
  std::vector<core::FixtureState> known_;  ///< the states those planes show, at level 1
  core::Plane offset_, lit_;
  std::vector<core::FixtureState> held_;  ///< the states that `offset_` shows
  core::FixtureState key_known_;
  std::optional<std::size_t> key_;
  Columns columns_;
  std::unique_ptr<LevelSolver> solver_;
  std::unique_ptr<AskedOfPlaces> asked_;  ///< null: no wishes
};

/// Hands workspaces to the optimiser's threads. Thread-safe.
class Workspaces {
 public:
  explicit Workspaces(const Setting& setting) : setting_(setting) {}
  std::unique_ptr<Workspace> borrow();
  void give_back(std::unique_ptr<Workspace> workspace);

 private:
  const Setting setting_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

/// `rig` with the given levels on the lamps that are lit by the design.
studio::Rig with_levels(const Variables& variables, studio::Rig rig,
                        std::span<const double> levels);

}  // namespace chiaro::design
