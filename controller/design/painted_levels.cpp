// SPDX-License-Identifier: Apache-2.0
#include "controller/design/painted_levels.h"

#include <algorithm>
#include <cmath>

#include "controller/measure/gram.h"
#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

constexpr int kQuickSteps = 3, kThoroughSteps = 12, kHalvings = 4;
constexpr double kEnough = 1e-5;  // of the cost: a smaller gain ends the solve
constexpr float kScale = 2.55f;   // working scalar per L*

/// d(working scalar)/dY at a working scalar; see WaveletLevels.
float slope_of(float value) {
  const float f = (value / kScale + 16) / 116;
  return std::min(kScale * 116 / (3 * f * f), kScale * 903.3f);
}

}  // namespace

double painted_distance(const Target& target, const core::Plane& luminance) {
  const core::Plane now = measure::working_scalar(luminance);
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < now.values.size(); ++i) {
    const double weight = target.emphasis.values[i];
    const double off = now.values[i] - target.values.values[i];
    weights += weight;
    // What was painted white, or was white, may be brighter than that.
    if (!target.clipped.values[i] || off < 0) sum += weight * off * off;
  }
  return weights > 0 ? std::sqrt(sum / weights) : 0;
}

double PaintedLevels::cost(const Columns& columns, std::span<const double> levels) {
  mix(columns, levels, picture_);
  return painted_distance(target_, picture_);
}

Levels PaintedLevels::solve(const Columns& columns, Effort effort) {
  const auto form = measure::least_squares_form(columns.planes, *columns.offset, target_.luminance,
                                                &target_.emphasis);
  Levels now;
  now.values = optimise::bounded_least_squares(form.q_matrix, form.q_vector, columns.bounds);
  now.cost = cost(columns, now.values);
  const int steps = effort == Effort::quick ? kQuickSteps : kThoroughSteps;
  for (int i = 0; i < steps; ++i) {
    const double before = now.cost;
    if (!step(columns, now) || before - now.cost < kEnough * before) break;
  }
  return now;
}

/// Least squares in linear light, each pixel weighted by how visible a change of its light is; what
/// is missing in L* is asked for along the tangent.
bool PaintedLevels::step(const Columns& columns, Levels& now) {
  mix(columns, now.values, picture_);
  const core::Plane values = measure::working_scalar(picture_);
  core::Plane wanted(picture_.size), weight(picture_.size);
  for (std::size_t i = 0; i < values.values.size(); ++i) {
    const float slope = slope_of(values.values[i]);
    const float off = target_.values.values[i] - values.values[i];
    const bool over = picture_.values[i] >= 1 && off >= 0;
    const bool done = target_.clipped.values[i] && off <= 0;
    wanted.values[i] = picture_.values[i] + off / slope;
    weight.values[i] = over || done ? 0.0f : target_.emphasis.values[i] * slope * slope;
  }
  const auto form = measure::least_squares_form(columns.planes, *columns.offset, wanted, &weight);
  const auto best =
      optimise::bounded_least_squares(form.q_matrix, form.q_vector, columns.bounds, now.values);
  Levels next;
  next.values.resize(best.size());
  double share = 1;
  for (int halving = 0; halving <= kHalvings; ++halving, share /= 2) {
    for (std::size_t k = 0; k < best.size(); ++k)
      next.values[k] = now.values[k] + share * (best[k] - now.values[k]);
    next.cost = cost(columns, next.values);
    if (next.cost < now.cost) {
      now = next;
      return true;
    }
  }
  return false;
}

}  // namespace chiaro::design
