// SPDX-License-Identifier: Apache-2.0
#include "controller/design/ideal.h"

#include <algorithm>
#include <cmath>

#include "controller/design/perceptual_levels.h"

namespace chiaro::design {
namespace {

constexpr int kElevations = 9, kHalfStops = 14;
// Above and behind, never at the middle of the vertices, where the thesis begins [I-24].
const core::Range kBackElevations{core::radians(30), core::radians(70)};
// A count over one threshold is soon full and says no more: edges that stand out clearly, and those
// that glow as a rim does, count again.
constexpr double kRims[] = {8, 16, 32};
// What a full back light must earn in edge share: light that shows no new edge is not spent.
constexpr double kPriceOfLight = 0.005;

/// The azimuth of a region that is nearest to straight behind the subject.
double behind(const core::Range& azimuth) {
  double best = azimuth.least, nearest = 10;
  for (const double straight : {-core::kPi, core::kPi}) {
    const double here = azimuth.clamp(straight);
    if (std::abs(here - straight) < nearest) {
      nearest = std::abs(here - straight);
      best = here;
    }
  }
  return best;
}

core::Range elevations(const core::Range& region) {
  const core::Range both{std::max(region.least, kBackElevations.least),
                         std::min(region.most, kBackElevations.most)};
  return both.width() >= 0 ? both : region;
}

/// Places worth a try: as it stands where its elevation is a back light's, then over those
/// elevations at its own azimuth and straight behind.
std::vector<core::FixtureState> places(const studio::Fixture& fixture,
                                       const core::FixtureState& now) {
  const studio::Region* region = region_of(fixture);
  const core::Range range = elevations(region->elevation);
  std::vector<core::FixtureState> places;
  if (range.contains(now.get(core::Dof::elevation))) places.push_back(now);
  for (const double azimuth : {now.get(core::Dof::azimuth), behind(region->azimuth)})
    for (int e = 0; e < kElevations; ++e) {
      core::FixtureState place = now;
      place.set(core::Dof::azimuth, azimuth);
      place.set(core::Dof::elevation, range.least + range.width() * e / (kElevations - 1));
      places.push_back(place);
    }
  return places;
}

std::vector<double> levels_to_try(const core::Range& limits) {
  std::vector<double> levels{0};
  for (int s = kHalfStops; s >= 0; --s) levels.push_back(limits.most * std::exp2(-0.5 * s));
  return levels;
}

/// One lamp alone is free; everything else is as in `rig`.
Variables only(const Variables& all, std::size_t fixture, const studio::Rig& rig) {
  Variables one;
  one.base = rig;
  one.lit = {fixture};
  for (std::size_t k = 0; k < all.lit.size(); ++k)
    if (all.lit[k] == fixture) one.limits = {all.limits[k]};
  for (std::size_t i = 0; i < rig.states.size(); ++i)
    if (i != fixture) one.held.push_back(i);
  return one;
}

/// Mean luminance of the subject and of all else.
std::pair<double, double> means(const core::Plane& luminance, const core::GeometryPlanes& planes) {
  double sums[2] = {0, 0}, counts[2] = {0, 0};
  for (std::size_t i = 0; i < luminance.values.size(); ++i) {
    const int subject = planes.subject.values[i] != 0;
    sums[subject] += std::min(1.0f, luminance.values[i]);
    ++counts[subject];
  }
  return {counts[1] > 0 ? sums[1] / counts[1] : 0, counts[0] > 0 ? sums[0] / counts[0] : 0};
}

struct Best {
  core::FixtureState state;
  double cost = std::numeric_limits<double>::infinity();
};

/// Tries levels at one place. `most_background` caps the background's mean at the subject's.
void try_levels(const Setting& setting, const measure::PixelMap& silhouette, Workspace& workspace,
                const Variables& one, const core::FixtureState& place, bool most_background,
                Best& best) {
  studio::Rig rig = one.base;
  rig.states[one.lit.front()] = place;
  const Columns& columns = workspace.columns(rig);
  core::Plane picture;
  for (const double level : levels_to_try(one.limits.front())) {
    mix(columns, std::vector<double>{level}, picture);
    if (most_background && level > 0 && setting.layers.geometry() != nullptr) {
      const auto [subject, background] = means(picture, *setting.layers.geometry());
      if (background > subject) break;
    }
    const double cost =
        1 - silhouette_share(picture, silhouette) + kPriceOfLight * level / one.limits.front().most;
    if (cost >= best.cost) continue;
    best = {place, cost};
    best.state.set(core::Dof::intensity, level);
  }
}

/// The lamp alone is set for the most silhouette at the least light; the first of equals wins.
core::FixtureState set_alone(const Setting& setting, const measure::PixelMap& silhouette,
                             const studio::Rig& rig, std::size_t fixture, bool may_move) {
  const studio::Fixture& lamp = setting.studio.fixtures[fixture];
  const bool background = stage_of(lamp.role) == IdealStage::background;
  const Variables one = only(setting.variables, fixture, rig);
  Workspace workspace(
      Setting{setting.studio, setting.layers, one, setting.target, setting.map, setting.accuracy});
  Best best;
  if (may_move && region_of(lamp) != nullptr)
    for (const auto& place : places(lamp, rig.states[fixture])) {
      studio::Rig there = rig;
      there.states[fixture] = place;
      if (setting.layers.infeasible(there, fixture).empty())
        try_levels(setting, silhouette, workspace, one, place, background, best);
    }
  if (!std::isfinite(best.cost))
    try_levels(setting, silhouette, workspace, one, rig.states[fixture], background, best);
  return best.state;
}

studio::Rig with_stage(const Setting& setting, studio::Rig rig, IdealStage stage, bool may_move) {
  const measure::PixelMap silhouette = silhouette_of(setting.map);
  for (const std::size_t fixture : setting.variables.lit)
    if (stage_of(setting.studio.fixtures[fixture].role) == stage)
      rig.states[fixture] = set_alone(setting, silhouette, rig, fixture, may_move);
  return rig;
}

}  // namespace

IdealStage stage_of(studio::Role role) {
  switch (role) {
    case studio::Role::back:
    case studio::Role::hair:
    case studio::Role::kicker:
      return IdealStage::back;
    case studio::Role::background:
      return IdealStage::background;
    case studio::Role::key:
    case studio::Role::fill:
    case studio::Role::practical:
      return IdealStage::shape;
  }
  return IdealStage::shape;
}

Variables variables_of(const studio::Studio& studio, const Variables& all, IdealStage stage,
                       const studio::Rig& base) {
  Variables part;
  part.base = base;
  part.held = all.held;
  for (std::size_t k = 0; k < all.lit.size(); ++k) {
    const std::size_t fixture = all.lit[k];
    if (stage_of(studio.fixtures[fixture].role) == stage) {
      part.lit.push_back(fixture);
      part.limits.push_back(all.limits[k]);
    } else {
      part.held.push_back(fixture);
      if (stage == IdealStage::shape) part.base.states[fixture].set(core::Dof::intensity, 0);
    }
  }
  std::sort(part.held.begin(), part.held.end());
  for (const Variable& variable : all.moving)
    if (stage_of(studio.fixtures[variable.fixture].role) == stage) part.moving.push_back(variable);
  return part;
}

measure::PixelMap silhouette_of(const measure::PixelMap& map) {
  auto type = map.type;
  for (std::size_t i = 0; i < type.values.size(); ++i)
    if (type.values[i] == measure::PixelType::edge && !map.external.values[i])
      type.values[i] = measure::PixelType::surface;
  return measure::pixel_map_of(std::move(type), map.external,
                               core::Grid<std::uint16_t>(map.type.size));
}

double silhouette_share(const core::Plane& luminance, const measure::PixelMap& silhouette) {
  double sum = 0;
  for (const double threshold : kRims) {
    measure::MeasureOptions options;
    options.edge_threshold = threshold;
    sum += measure::components_of_luminance(luminance, silhouette, nullptr, options).edge;
  }
  return sum / std::size(kRims);
}

measure::IdealTargets attainable_targets(const Setting& setting) {
  measure::IdealTargets most = setting.target.ideal;
  if (setting.variables.lit.empty()) return most;
  most.gradient = 0;
  most.contrast = 0;
  const auto& lit = setting.variables.lit;
  const std::size_t key = key_of(setting.studio).value_or(lit.front());
  const auto found = std::find(lit.begin(), lit.end(), key);
  const std::size_t k = found == lit.end() ? 0 : static_cast<std::size_t>(found - lit.begin());
  Workspace workspace(setting);
  std::vector<double> shares(lit.size(), 0);
  shares[k] = 1;
  core::Plane picture;
  const optimise::Point placed = setting.variables.point(setting.variables.base);
  for (const auto& point : lattice(setting.variables, lit[k], placed)) {
    const studio::Rig rig = setting.variables.rig(point);
    if (!setting.layers.infeasible(rig, lit[k]).empty()) continue;
    const Columns& columns = workspace.columns(rig);
    mix(columns, scaled_to_mean(columns, setting.map, shares, setting.target.ideal.mean), picture);
    const auto seen = measure::components_of_luminance(picture, setting.map, columns.lit);
    most.gradient = std::max(most.gradient, seen.gradient);
    most.contrast = std::max(most.contrast, seen.contrast);
  }
  return most;
}

studio::Rig with_back_lights(const Setting& setting, studio::Rig rig, bool may_move) {
  return with_stage(setting, std::move(rig), IdealStage::back, may_move);
}

studio::Rig with_background_lights(const Setting& setting, studio::Rig rig) {
  return with_stage(setting, std::move(rig), IdealStage::background, false);
}

}  // namespace chiaro::design
