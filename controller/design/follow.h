// SPDX-License-Identifier: Apache-2.0
// Light that follows: a tracked subject moves as a whole, and thirty times a second the view is
// seen again, the levels are solved again for it from where they were, heads turn after it and
// motors on arcs and tracks step to where the picture comes nearer. What goes to the lamps is
// smooth: it nears the solution at a bounded rate, so that nothing flickers however the tracker
// trembles. Stands stay where they are.
#pragma once

#include <memory>
#include <optional>

#include "controller/design/design.h"
#include "controller/design/levels.h"
#include "controller/design/variables.h"
#include "controller/render/view.h"

namespace chiaro::design {

struct FollowOptions {
  core::Size size{256, 256};
  double settle_s = 0.25;        ///< the rest of the way to the solution falls to 1/e in that time
  double most_per_s = 0.5;       ///< no level changes faster; a fraction of full output
  double turn_per_s = 1;         ///< no head turns faster; radians
  double travel_per_s = 0.1;     ///< nothing on an arc or a track goes faster; a share of its way
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
  /// Without a goal: the subject keeps the light that `look` gives it where the studio file has
  /// it, part of the surface by part. Lamps that hardly reach it (a background's) stay as they are.
  Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
           const studio::Rig& look, const std::vector<std::string>& locked = {},
           const FollowOptions& options = {});
  ~Follower();

  struct Frame {
    studio::Rig rig;      ///< to send now
    double cost = 0;      ///< of the solution it nears
    double change = 0;    ///< the largest change of a level since the last frame
    double turn = 0;      ///< of a head's pan or tilt, radians
    double travel = 0;    ///< along an arc or a track, a share of its way
    bool in_view = true;  ///< false: the camera sees nothing of the subject, and levels are held
  };
  /// The subject now stands `moved` from where the studio file has it; `seconds` since the last
  /// call.
  Frame follow(const render::Motion& moved, double seconds);

 private:
  /// A head that points at the subject, and the point of it.
  struct Head {
    std::size_t fixture;
    core::Range pan, tilt;
    core::Vec3 mark;
  };
  /// An arc's or a track's motor, and where it is to go.
  struct Motor {
    std::size_t lamp;  ///< index into Variables::lit
    core::Dof dof;
    core::Range range;
    double wanted;
  };
  Follower(const studio::Studio& studio, std::shared_ptr<const twin::Geometry> geometry,
           const Goal* goal, const studio::Rig& look, const std::vector<std::string>& locked,
           const FollowOptions& options);
  void find_motors();
  void choose_goal(const Goal* goal);
  void find_weak_lamps();
  void light_alone(const render::View& view, std::size_t fixture, const core::FixtureState& state,
                   core::Plane& out) const;
  void fetch(const render::View& view);
  void want_the_look(const render::View& view, const render::Motion& moved);
  void step_motor(const render::View& view, Columns columns, double cost);
  void turn_heads(const render::Motion& moved, double seconds, Frame& frame);
  void travel(double seconds, Frame& frame);
  void near_levels(double seconds, Frame& frame);
  /// A step of what is sent towards what is wanted.
  double nearer(double now, double wanted, double seconds, double most_per_s) const;

  const studio::Studio& studio_;
  const FollowOptions options_;
  render::MovingTracer tracer_;
  std::shared_ptr<const render::Tracer> at_rest_;
  std::shared_ptr<const twin::Geometry> geometry_;
  const studio::Rig look_;
  bool keeps_ = false;  ///< the look's own light is the goal
  Target target_;
  Variables lamps_;
  std::vector<core::Range> bounds_;  ///< beside `lamps_.lit`; without width for weak lamps
  std::vector<Head> heads_;
  std::vector<Motor> motors_;
  std::size_t turn_of_motor_ = 0;
  studio::Rig rig_;
  std::vector<double> aims_;  ///< the levels that the rig nears
  double gain_;
  measure::PixelMap map_;
  std::unique_ptr<LevelSolver> solver_;
  std::vector<core::Plane> planes_;
  core::Plane offset_, spare_;
};

}  // namespace chiaro::design
