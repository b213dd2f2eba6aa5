// SPDX-License-Identifier: Apache-2.0
#include "controller/design/asked_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "controller/design/perceptual_levels.h"

namespace chiaro::design {
namespace {

constexpr std::array<double, 2> kQuickSteps{1, 1.0 / 3};
constexpr std::array<double, 6> kThoroughSteps{2, 1, 0.5, 0.2, 0.07, 0.02};
constexpr double kDark = 1e-3;      // of the range: darker lamps start from here
constexpr double kAllGrey = 127.5;  // a painted picture's worst, in the working scalar
constexpr double kBroken = 10;      // price of missing a bound by all of it
constexpr double kHolds = 1e-6;     // of the limit
constexpr int kProjections = 100;   // cyclic; two or three lines meet within ten or so

/// How far `value` is outside of a bound, signed towards where it should go.
double missing(const LinearBound& bound, double value) {
  return value < bound.least ? bound.least - value : value > bound.most ? bound.most - value : 0;
}

double value_of(const LinearBound& bound, std::span<const double> levels) {
  double value = bound.constant;
  for (std::size_t k = 0; k < levels.size(); ++k) value += bound.per_level[k] * levels[k];
  return value;
}

double worst_of(const Columns& columns, std::span<const double> levels) {
  double worst = 0;
  for (const LinearBound& bound : columns.linear) {
    const double off = std::abs(missing(bound, value_of(bound, levels)));
    const double limit = std::abs(std::isfinite(bound.most) ? bound.most : bound.least);
    worst = std::max(worst, off / std::max(limit, 1e-9));
  }
  return worst <= kHolds ? 0 : worst;
}

/// Along the bound's own direction, over the lamps that can still go that way.
void lay_on(const LinearBound& bound, const Columns& columns, std::vector<double>& levels) {
  const double off = missing(bound, value_of(bound, levels));
  if (off == 0) return;
  double square = 0;
  const auto free = [&](std::size_t k) {
    const double way = off * bound.per_level[k];
    return way > 0 ? levels[k] < columns.bounds[k].most
                   : way < 0 && levels[k] > columns.bounds[k].least;
  };
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (free(k)) square += bound.per_level[k] * bound.per_level[k];
  if (square <= 0) return;
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (free(k)) levels[k] = columns.bounds[k].clamp(levels[k] + off * bound.per_level[k] / square);
}

bool looks_at_picture(const Asked& asked) {
  if (!asked.wishes->terms.empty()) return true;
  const auto& wishes = asked.wishes->wishes;
  return std::any_of(wishes.begin(), wishes.end(), [](const Wish& wish) {
    return wish.weight > 0 &&
           (wish.kind == Wish::Kind::lightness || wish.kind == Wish::Kind::spread_at_most ||
            wish.kind == Wish::Kind::spread_at_least);
  });
}

}  // namespace

double lay_on_bounds(const Columns& columns, std::vector<double>& levels) {
  if (columns.linear.empty()) return 0;
  for (int round = 0; round < kProjections && worst_of(columns, levels) > 0; ++round)
    for (const LinearBound& bound : columns.linear) lay_on(bound, columns, levels);
  return worst_of(columns, levels);
}

AskedLevels::AskedLevels(std::unique_ptr<LevelSolver> goal, const Target& target,
                         const measure::PixelMap& map)
    : goal_(std::move(goal)), target_(target), map_(map) {
  for (const Asked::Side& side : target.asked->sides)
    sides_.push_back(level_solver(side.target, side.map));
}

/// What a wish of weight 1 costs at its worst: as much as a picture with every lamp dark does where
/// costs are distances, 1 where they are sums of terms.
double AskedLevels::scale(const Columns& columns) {
  if (target_.kind == Target::Kind::ideal || target_.kind == Target::Kind::perceptual) return 1;
  if (target_.kind == Target::Kind::painted) return kAllGrey;
  const std::vector<double> dark(columns.planes.size(), 0);
  return std::max(1.0, goal_->cost(columns, dark));
}

double AskedLevels::cost(const Columns& columns, std::span<const double> levels) {
  const Asked& asked = *target_.asked;
  double extra = kBroken * worst_of(columns, levels);
  for (const Highlight& highlight : columns.highlights) extra += highlight.cost(levels);
  for (const ShadowShare& shadow : columns.shadows) {
    const double share = shadow.share(levels);
    extra += shadow.weight * (shadow.wanted ? 1 - share : share);
  }
  if (looks_at_picture(asked)) {
    mix(columns, levels, picture_);
    for (std::size_t w = 0; w < asked.masks.size(); ++w)
      if (asked.wishes->wishes[w].weight > 0)
        extra += asked.wishes->wishes[w].weight *
                 picture_cost(asked.wishes->wishes[w], asked.masks[w], picture_);
    if (!asked.wishes->terms.empty())
      extra += term_cost(asked, seen_of(asked, picture_, columns, levels));
  }
  double sides = 0;
  for (std::size_t s = 0; s < sides_.size(); ++s)
    sides += asked.sides[s].weight * sides_[s]->cost(*columns.elsewhere[s], levels);
  return goal_->cost(columns, levels) + sides + scale(columns) * extra;
}

bool AskedLevels::tried(const Columns& columns, std::vector<double> levels, Levels& best) {
  lay_on_bounds(columns, levels);
  const double now = cost(columns, levels);
  if (!(now < best.cost)) return false;
  best = {std::move(levels), now};
  return true;
}

bool AskedLevels::improve(const Columns& columns, Levels& now, std::size_t k, double stops) {
  const core::Range bounds = columns.bounds[k];
  const double dark = bounds.least + kDark * bounds.width(), old = now.values[k];
  const double up = old < dark ? 4 * dark : old * std::exp2(stops);
  const double down = old * std::exp2(-stops);
  for (const double wish : {up, down < dark ? bounds.least : down}) {
    std::vector<double> levels = now.values;
    levels[k] = bounds.clamp(wish);
    if (levels[k] != old && tried(columns, std::move(levels), now)) return true;
  }
  return false;
}

Levels AskedLevels::solve(const Columns& columns, Effort effort) {
  Levels best;
  best.cost = std::numeric_limits<double>::infinity();
  tried(columns, goal_->solve(columns, effort).values, best);
  if (looks_at_picture(*target_.asked) || !columns.highlights.empty()) {
    const std::vector<double> even(columns.planes.size(), 1);
    for (const double mean : {90.0, 140.0})
      tried(columns, scaled_to_mean(columns, map_, even, mean), best);
  } else if (columns.linear.empty() && columns.shadows.empty() && sides_.empty()) {
    return best;
  }
  const bool quick = effort == Effort::quick;
  const std::span<const double> steps =
      quick ? std::span<const double>(kQuickSteps) : std::span<const double>(kThoroughSteps);
  const int sweeps = quick ? 2 : 8;
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
