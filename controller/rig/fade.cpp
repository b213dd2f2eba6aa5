// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/fade.h"

#include <algorithm>
#include <cmath>

#include "controller/core/colour.h"

namespace chiaro::rig {

using core::Dof;

bool is_light(Dof dof) {
  return dof == Dof::intensity || (core::is_colour(dof) && dof != Dof::cct && dof != Dof::tint);
}

double fade_scale(Dof dof, double value) {
  if (is_light(dof)) return core::lightness(value);
  if (dof == Dof::cct && value > 0) return 1e6 / value;
  return value;
}

double fade_value(Dof dof, double scaled) {
  if (is_light(dof)) return core::luminance_of_lightness(scaled);
  if (dof == Dof::cct && scaled > 0) return 1e6 / scaled;
  return scaled;
}

double blend(Dof dof, double from, double to, double x) {
  if (x <= 0) return from;
  if (x >= 1) return to;
  const double value = fade_value(dof, std::lerp(fade_scale(dof, from), fade_scale(dof, to), x));
  return std::clamp(value, std::min(from, to), std::max(from, to));
}

double progress(ports::TimePoint start, double seconds, ports::TimePoint now) {
  if (seconds <= 0) return 1;
  const double gone = std::chrono::duration<double>(now - start).count();
  return std::clamp(gone / seconds, 0.0, 1.0);
}

void Fade::start(double from, double to, ports::TimePoint now, double seconds) {
  from_ = from;
  to_ = to;
  from_scaled_ = fade_scale(dof_, from);
  to_scaled_ = fade_scale(dof_, to);
  start_ = now;
  seconds_ = seconds;
}

double Fade::at(ports::TimePoint now) const {
  const double x = progress(start_, seconds_, now);
  if (x >= 1) return to_;
  if (x <= 0) return from_;
  const double value = fade_value(dof_, std::lerp(from_scaled_, to_scaled_, x));
  return std::clamp(value, std::min(from_, to_), std::max(from_, to_));
}

void Fade::confine(double least, double most) {
  from_ = std::clamp(from_, least, most);
  to_ = std::clamp(to_, least, most);
  from_scaled_ = fade_scale(dof_, from_);
  to_scaled_ = fade_scale(dof_, to_);
}

}  // namespace chiaro::rig
