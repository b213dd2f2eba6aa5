// SPDX-License-Identifier: Apache-2.0
// One degree of freedom on its way from one value to another, as a function of time alone: a late
// tick skips ahead, it never stretches the fade.
#pragma once

#include "controller/core/dof.h"
#include "controller/ports/clock.h"

namespace chiaro::rig {

/// True for levels of light (intensity and emitter drives), which fade evenly in lightness.
bool is_light(core::Dof dof);
/// The space in which a DOF fades evenly, and back: L* for light, mired for CCT, itself else.
double fade_scale(core::Dof dof, double value);
double fade_value(core::Dof dof, double scaled);
/// `x` of the way from one value to the other; exact at 0 and 1, monotonic between.
double blend(core::Dof dof, double from, double to, double x);

/// Real-time.
class Fade {
 public:
  explicit Fade(core::Dof dof = core::Dof::intensity, double value = 0)
      : dof_(dof), from_(value), to_(value) {}

  void start(double from, double to, ports::TimePoint now, double seconds);
  double at(ports::TimePoint now) const;
  double target() const { return to_; }
  double seconds() const { return seconds_; }
  bool done(ports::TimePoint now) const {
    return seconds_ <= 0 || std::chrono::duration<double>(now - start_).count() >= seconds_;
  }
  /// Is at its target at once.
  void end() { seconds_ = 0; }
  /// Moves both ends into a range; a fade that runs goes on.
  void confine(double least, double most);

 private:
  core::Dof dof_;
  double from_, to_;
  double from_scaled_ = 0, to_scaled_ = 0;
  double seconds_ = 0;
  ports::TimePoint start_;
};

/// 0..1 of a span that began at `start`; 1 for an empty span.
double progress(ports::TimePoint start, double seconds, ports::TimePoint now);

}  // namespace chiaro::rig
