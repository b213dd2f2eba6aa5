// SPDX-License-Identifier: Apache-2.0
// One goal on one scene, ready to be tried at any rig: what the studies that look inside a search
// share. Places and, unless they are solved, levels are the variables.
#pragma once

#include <memory>
#include <mutex>

#include "controller/daemon/study/scenes.h"
#include "controller/design/stages.h"
#include "controller/optimise/optimiser.h"

namespace chiaro::daemon::study {

/// A scene with its twin.
struct Stage {
  std::string name;
  studio::Studio studio;
  std::unique_ptr<design::LayersSource> twin;
};
core::Result<Stage> stage(std::string_view name, const Lamps& lamps, int threads,
                          ports::World& world);

enum class Levels { searched, solved };

/// Thread-safe. `stage` must outlive it.
class Lab {
 public:
  Lab(const Stage& stage, const design::Goal& goal, core::Size size, Levels levels);

  std::vector<core::Range> bounds() const;
  optimise::Point start() const;  ///< where the lamps stand, at half their light
  studio::Rig rig(std::span<const double> point) const;
  optimise::Point point(const studio::Rig& rig) const;
  double cost(std::span<const double> point);
  /// Display-linear luminance of the rig with its own levels.
  core::Plane picture(const studio::Rig& rig);
  measure::Components components(const studio::Rig& rig);

  const design::Target& target() const { return prepared_.target; }
  const measure::PixelMap& map() const { return prepared_.map; }
  const design::Layers& layers() const { return prepared_.layers; }
  /// Runs an optimiser from start().
  optimise::Outcome minimise(std::string_view optimiser, std::uint64_t trials, std::uint64_t seed,
                             int threads, const std::atomic<bool>& stop);

 private:
  const Levels levels_;
  const design::Variables all_, lamps_;
  const design::Prepared prepared_;
  const design::Setting setting_;
  design::Workspaces workspaces_;
};

/// The best value found up to each trial, 1 to `trials`, from an outcome's improvements.
std::vector<double> best_by_trial(const optimise::Outcome& outcome, std::uint64_t trials);

}  // namespace chiaro::daemon::study
