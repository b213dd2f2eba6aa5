// SPDX-License-Identifier: Apache-2.0
#include "controller/design/perceptual_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "controller/measure/gram.h"
#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

// Steps of the pattern search in stops; a dark lamp is lit at, and a lamp below goes dark at, a
// level that adds kDark of the range.
constexpr double kQuickSteps[] = {1, 0.5, 0.2};
constexpr double kThoroughSteps[] = {1.5, 0.7, 0.35, 0.15, 0.06, 0.03};
constexpr double kDark = 1.0 / 256;
// Mean L* is not the L* of the mean light; over real pictures it sits a little lower.
constexpr double kMeanLight = 1.15;

double mean_light(double working_scalar) {
  return kMeanLight * core::luminance_of_lightness(working_scalar / 2.55);
}

}  // namespace

std::vector<double> scaled_to_mean(const Columns& columns, const measure::PixelMap& map,
                                   std::span<const double> shares, double mean) {
  double lamps = 0, offset = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < map.type.values.size(); ++i) {
    if (map.type.values[i] != measure::PixelType::surface) continue;
    ++counted;
    offset += columns.offset->values[i];
    for (std::size_t k = 0; k < shares.size(); ++k)
      lamps += shares[k] * columns.planes[k]->values[i];
  }
  std::vector<double> levels(shares.begin(), shares.end());
  const double wanted = mean_light(mean) * static_cast<double>(counted) - offset;
  for (std::size_t k = 0; k < levels.size(); ++k)
    levels[k] = columns.bounds[k].clamp(lamps > 0 ? levels[k] * std::max(0.0, wanted) / lamps : 0);
  return levels;
}

PerceptualLevels::PerceptualLevels(const Target& target, const measure::PixelMap& map)
    : target_(target), map_(map) {}

double PerceptualLevels::cost(const Columns& columns, std::span<const double> levels) {
  mix(columns, levels, picture_);
  const auto now = measure::components_of_luminance(picture_, map_, columns.lit);
  return target_.kind == Target::Kind::ideal
             ? measure::ideal_cost(now, target_.ideal, target_.weights)
             : measure::perceptual_cost(now, target_.targets, target_.weights);
}

std::vector<std::vector<double>> PerceptualLevels::starts(const Columns& columns) const {
  const std::size_t lamps = columns.planes.size();
  std::vector<std::vector<double>> starts;
  const double mean = target_.kind == Target::Kind::ideal ? target_.ideal.mean
                                                          : target_.targets.mean.value_or(127.5);
  std::vector<double> shares(lamps, 1);
  starts.push_back(scaled_to_mean(columns, map_, shares, mean));
  for (std::size_t main = 0; main < std::min<std::size_t>(lamps, 2) && lamps > 1; ++main) {
    std::fill(shares.begin(), shares.end(), 0.2);
    shares[main] = 1;
    starts.push_back(scaled_to_mean(columns, map_, shares, mean));
  }
  if (!target_.luminance.empty()) {
    const auto form = measure::haar_form(columns.planes, *columns.offset, target_.luminance);
    starts.push_back(optimise::bounded_least_squares(form.q_matrix, form.q_vector, columns.bounds));
  }
  return starts;
}

bool PerceptualLevels::improve(const Columns& columns, Levels& now, std::size_t k, double stops) {
  const core::Range bounds = columns.bounds[k];
  const double dark = bounds.least + kDark * bounds.width();
  const double old = now.values[k];
  const double up = old < dark ? 4 * dark : old * std::exp2(stops);
  const double down = old < dark ? bounds.least : old * std::exp2(-stops);
  for (const double wish : {up, down < dark ? bounds.least : down}) {
    const double level = bounds.clamp(wish);
    if (level == old) continue;
    now.values[k] = level;
    const double tried = cost(columns, now.values);
    if (tried < now.cost) {
      now.cost = tried;
      return true;
    }
  }
  now.values[k] = old;
  return false;
}

Levels PerceptualLevels::solve(const Columns& columns, Effort effort) {
  Levels best;
  best.cost = std::numeric_limits<double>::infinity();
  for (auto& start : starts(columns)) {
    const double tried = cost(columns, start);
    if (tried < best.cost) best = {std::move(start), tried};
  }
  const bool quick = effort == Effort::quick;
  const std::span<const double> steps =
      quick ? std::span<const double>(kQuickSteps) : std::span<const double>(kThoroughSteps);
  const int sweeps = quick ? 1 : 6;
  for (const double stops : steps)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      bool better = false;
      for (std::size_t k = 0; k < columns.planes.size(); ++k)
        better |= improve(columns, best, k, stops);
      if (!better) break;
    }
  return best;
}

}  // namespace chiaro::design
