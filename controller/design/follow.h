// SPDX-License-Identifier: Apache-2.0
// Light that follows: a tracked subject moves as a whole, and thirty times a second the view is
// seen again and the levels are solved again for it. Stands stay where they are. What goes to the
// lamps is smooth: it nears the solution at a bounded rate, so that nothing flickers however the
// tracker trembles.
#pragma once

#include <memory>

#include "controller/design/design.h"
#include "controller/design/levels.h"
#include "controller/design/variables.h"
#include "controller/render/view.h"

namespace chiaro::design {

struct FollowOptions {
  core::Size size{256, 256};
  double settle_s = 0.25;        ///< the rest of the way to the solution falls to 1/e in that time
  double most_per_s = 0.5;       ///< no level changes faster; a fraction of full output
  double dead_band = 1.0 / 512;  ///< a solution that differs less than this is noise
};

/// Thread-bound: one caller. Shadows are hard, one ray per lamp and pixel, and lamps the mesh does
/// not know (an uncontrolled practical's measured frame) are left out.
class Follower {
 public:
  /// `studio` outlives this. `look` is where the lamps stand and how they shine at the beginning;
  /// lamps named in `locked` and uncontrolled ones shine on as there. Precondition: the goal has no
  /// problems, `size` is as in Options.
  Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
           const Goal& goal, const studio::Rig& look, const std::vector<std::string>& locked = {},
           const FollowOptions& options = {});
  ~Follower();

  struct Frame {
    studio::Rig rig;    ///< to send now
    double cost = 0;    ///< of the solution it nears
    double change = 0;  ///< the largest change of a level since the last frame
  };
  /// The subject now stands `moved` from where the studio file has it; `seconds` since the last
  /// call.
  Frame follow(const render::Motion& moved, double seconds);

 private:
  void fetch(const render::View& view);

  const studio::Studio& studio_;
  const FollowOptions options_;
  render::MovingTracer tracer_;
  std::shared_ptr<const twin::Geometry> geometry_;
  Target target_;
  Variables lamps_;
  studio::Rig rig_;
  std::vector<double> aims_;  ///< the levels that the rig nears
  double gain_;
  measure::PixelMap map_;
  std::unique_ptr<LevelSolver> solver_;
  std::vector<core::Plane> planes_;
  core::Plane offset_;
};

}  // namespace chiaro::design
