// SPDX-License-Identifier: Apache-2.0
#include "controller/design/wavelet_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/measure/gram.h"
#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

constexpr int kQuickSteps = 3, kThoroughSteps = 12, kHalvings = 3;
// A step that gains less than this share of the cost ends the solve.
constexpr double kEnough = 1e-4;
constexpr float kScale = 2.55f;  // working scalar per L*

/// dL*/dY x 2.55 from the working scalar itself: L* = 116 Y^(1/3) - 16, so dL*/dY = 116/3 / f^2.
float slope_of(float value) {
  const float f = (value / kScale + 16) / 116;
  return std::min(kScale * 116 / (3 * f * f), kScale * 903.3f);
}

}  // namespace

WaveletLevels::WaveletLevels(const Target& target)
    : target_(target),
      nothing_(target.size),
      ceiling_(target.size, std::numeric_limits<float>::infinity()),
      zero_(measure::haar_spectrum(nothing_, target.size.width)) {
  for (std::size_t i = 0; i < ceiling_.values.size(); ++i)
    if (target.clipped.values[i]) ceiling_.values[i] = target.values.values[i];
}

Levels WaveletLevels::solve(const Columns& columns, Effort effort) {
  Levels now;
  now.values = linear_solution(columns);
  now.cost = cost(columns, now.values);
  const int steps = effort == Effort::quick ? kQuickSteps : kThoroughSteps;
  for (int i = 0; i < steps; ++i) {
    const double before = now.cost;
    if (!step(columns, now) || before - now.cost < kEnough * before) break;
  }
  return now;
}

double WaveletLevels::cost(const Columns& columns, std::span<const double> levels) {
  linearise(columns, levels);
  return measure::haar_distance(measure::haar_spectrum(difference_, target_.size.width), zero_);
}

std::vector<double> WaveletLevels::linear_solution(const Columns& columns) const {
  const auto form = measure::haar_form(columns.planes, *columns.offset, target_.luminance);
  return optimise::bounded_least_squares(form.q_matrix, form.q_vector, columns.bounds);
}

void WaveletLevels::linearise(const Columns& columns, std::span<const double> levels) {
  mix(columns, levels, picture_);
  difference_ = measure::working_scalar(picture_);
  slope_.size = picture_.size;
  slope_.values.resize(picture_.values.size());
  // Floats and selects only, so that the compiler makes vectors of it.
  const float* wanted = target_.values.values.data();
  const float* ceiling = ceiling_.values.data();
  const float* light = picture_.values.data();
  float* difference = difference_.values.data();
  float* slope = slope_.values.data();
  for (std::size_t i = 0; i < picture_.values.size(); ++i) {
    const float value = difference[i], here = slope_of(value);
    const float shows = value >= ceiling[i] ? 0.0f : 1.0f;
    difference[i] = shows * (value - wanted[i]);
    slope[i] = light[i] >= 1 ? 0.0f : shows * here;
  }
}

bool WaveletLevels::step(const Columns& columns, Levels& now) {
  linearise(columns, now.values);
  weighted_.resize(columns.planes.size());
  rest_ = difference_;
  std::vector<const core::Plane*> weighted;
  for (std::size_t k = 0; k < columns.planes.size(); ++k) {
    weighted_[k] = *columns.planes[k];
    const auto level = static_cast<float>(now.values[k]);
    for (std::size_t i = 0; i < rest_.values.size(); ++i) {
      weighted_[k].values[i] *= slope_.values[i];
      rest_.values[i] -= level * weighted_[k].values[i];
    }
    weighted.push_back(&weighted_[k]);
  }
  const auto form = measure::haar_form(weighted, rest_, nothing_);
  const auto wanted =
      optimise::bounded_least_squares(form.q_matrix, form.q_vector, columns.bounds, now.values);
  Levels next;
  next.values.resize(wanted.size());
  double share = 1;
  for (int halving = 0; halving <= kHalvings; ++halving, share /= 2) {
    for (std::size_t k = 0; k < wanted.size(); ++k)
      next.values[k] = now.values[k] + share * (wanted[k] - now.values[k]);
    next.cost = cost(columns, next.values);
    if (next.cost < now.cost) {
      now = next;
      return true;
    }
  }
  return false;
}

}  // namespace chiaro::design
