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
// A quick solve steps this many lamps, and asks the Haar form of this many where to begin.
constexpr std::size_t kQuickLamps = 5, kQuickForm = 8;
// Mean L* is not the L* of the mean light; over real pictures it sits a little lower.
constexpr double kMeanLight = 1.15;

double mean_light(double working_scalar) {
  return kMeanLight * core::luminance_of_lightness(working_scalar / 2.55);
}

/// Sum over the surface pixels. Sixteen sums side by side, so that the compiler makes vectors of
/// it.
double surface_sum(const core::Plane& plane, const measure::PixelMap& map) {
  constexpr std::size_t kLanes = 16;
  const auto& types = map.type.values;
  const float* values = plane.values.data();
  float lanes[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= types.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k)
      lanes[k] += types[i + k] == measure::PixelType::surface ? values[i + k] : 0.0f;
  double sum = 0;
  for (const float lane : lanes) sum += static_cast<double>(lane);
  for (; i < types.size(); ++i)
    if (types[i] == measure::PixelType::surface) sum += static_cast<double>(values[i]);
  return sum;
}

std::vector<double> scaled(std::span<const double> given, double offset, std::size_t counted,
                           std::span<const core::Range> bounds, std::span<const double> shares,
                           double mean) {
  double lamps = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) lamps += shares[k] * given[k];
  const double wanted = mean_light(mean) * static_cast<double>(counted) - offset;
  std::vector<double> levels(shares.begin(), shares.end());
  for (std::size_t k = 0; k < levels.size(); ++k)
    levels[k] = bounds[k].clamp(lamps > 0 ? levels[k] * std::max(0.0, wanted) / lamps : 0);
  return levels;
}

std::vector<double> light_of_each(const Columns& columns, const measure::PixelMap& map) {
  std::vector<double> given;
  for (const core::Plane* plane : columns.planes) given.push_back(surface_sum(*plane, map));
  return given;
}

}  // namespace

std::vector<double> scaled_to_mean(const Columns& columns, const measure::PixelMap& map,
                                   std::span<const double> shares, double mean) {
  return scaled(light_of_each(columns, map), surface_sum(*columns.offset, map), map.surfaces,
                columns.bounds, shares, mean);
}

PerceptualLevels::PerceptualLevels(const Target& target, const measure::PixelMap& map)
    : target_(target), map_(map) {}

double PerceptualLevels::cost(const Columns& columns, std::span<const double> levels) {
  mix(columns, levels, picture_);
  return cost_of(picture_, columns);
}

double PerceptualLevels::cost_of(const core::Plane& picture, const Columns& columns) const {
  const auto now = measure::components_of_luminance(picture, map_, columns.lit);
  return target_.kind == Target::Kind::ideal
             ? measure::ideal_cost(now, target_.ideal, target_.weights)
             : measure::perceptual_cost(now, target_.targets, target_.weights);
}

std::vector<std::vector<double>> PerceptualLevels::starts(const Columns& columns,
                                                          Effort effort) const {
  const std::size_t lamps = columns.planes.size();
  std::vector<std::vector<double>> starts;
  const double mean = target_.kind == Target::Kind::ideal ? target_.ideal.mean
                                                          : target_.targets.mean.value_or(127.5);
  const double offset = surface_sum(*columns.offset, map_);
  const auto add = [&](std::span<const double> shares) {
    starts.push_back(scaled(given_, offset, map_.surfaces, columns.bounds, shares, mean));
  };
  std::vector<double> shares(lamps, 1);
  add(shares);
  for (std::size_t main = 0; main < std::min<std::size_t>(lamps, 2) && lamps > 1; ++main) {
    std::fill(shares.begin(), shares.end(), 0.2);
    shares[main] = 1;
    add(shares);
  }
  if (!target_.luminance.empty() && (effort == Effort::thorough || lamps <= kQuickForm)) {
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
  const float* lamp = columns.planes[k]->values.data();
  changed_.size = picture_.size;
  changed_.values.resize(picture_.values.size());
  for (const double wish : {up, down < dark ? bounds.least : down}) {
    const double level = bounds.clamp(wish);
    if (level == old) continue;
    const auto more = static_cast<float>(level - old);
    const float* from = picture_.values.data();
    float* to = changed_.values.data();
    for (std::size_t i = 0; i < changed_.values.size(); ++i) to[i] = from[i] + more * lamp[i];
    const double tried = cost_of(changed_, columns);
    if (tried < now.cost) {
      now.values[k] = level;
      now.cost = tried;
      std::swap(picture_, changed_);
      return true;
    }
  }
  return false;
}

Levels PerceptualLevels::solve(const Columns& columns, Effort effort) {
  const bool quick = effort == Effort::quick;
  given_ = light_of_each(columns, map_);
  Levels best;
  best.cost = std::numeric_limits<double>::infinity();
  for (auto& start : starts(columns, effort)) {
    const double tried = cost(columns, start);
    if (tried < best.cost) best = {std::move(start), tried};
  }
  if (best.values.empty()) {  // nothing to measure: every cost was no number
    for (const core::Range& bounds : columns.bounds) best.values.push_back(bounds.least);
    return best;
  }
  const std::span<const double> steps =
      quick ? std::span<const double>(kQuickSteps) : std::span<const double>(kThoroughSteps);
  const int sweeps = quick ? 1 : 6;
  std::vector<std::size_t> order(columns.planes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  mix(columns, best.values, picture_);
  for (const double stops : steps)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (quick && order.size() > kQuickLamps)
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
          return best.values[a] * given_[a] > best.values[b] * given_[b];
        });
      bool better = false;
      const std::size_t most = quick ? std::min(kQuickLamps, order.size()) : order.size();
      for (std::size_t k = 0; k < most; ++k) better |= improve(columns, best, order[k], stops);
      if (!better) break;
    }
  best.cost = cost(columns, best.values);
  return best;
}

}  // namespace chiaro::design
