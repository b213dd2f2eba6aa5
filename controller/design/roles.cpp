// SPDX-License-Identifier: Apache-2.0
#include "controller/design/roles.h"

#include <algorithm>
#include <cmath>

#include "controller/design/words.h"

namespace chiaro::design {
namespace {

// A swap may cost this much more; a lamp whose light changes the cost less than that is idle.
constexpr double kSwapPrice = 1.05, kIdle = 1.005;
// And nobody sees a tenth of a grey level, or its like among the components.
constexpr double kUnseenGrey = 0.1, kUnseenCost = 0.002;

std::optional<std::size_t> mover_of(const Setting& setting, studio::Role role) {
  for (const std::size_t fixture : setting.variables.movers())
    if (setting.studio.fixtures[fixture].role == role) return fixture;
  return std::nullopt;
}

/// Each of the two lamps at the other's place, as far as its region goes.
optimise::Point swapped(const Variables& variables, const optimise::Point& point, std::size_t a,
                        std::size_t b) {
  studio::Rig rig = variables.rig(point);
  for (const core::Dof dof : {core::Dof::azimuth, core::Dof::elevation, core::Dof::distance}) {
    const double of_a = rig.states[a].get(dof), of_b = rig.states[b].get(dof);
    rig.states[a].set(dof, of_b);
    rig.states[b].set(dof, of_a);
  }
  return variables.point(rig);
}

}  // namespace

Found with_roles_kept(const Setting& setting, Found found, const Options& options, Watch& watch) {
  const auto key = mover_of(setting, studio::Role::key);
  const auto fill = mover_of(setting, studio::Role::fill);
  if (!key || !fill || !std::isfinite(found.cost)) return found;
  const studio::Rig places = setting.variables.rig(found.point);
  const auto levels = Workspace(setting).solve(places, Effort::quick).levels;
  const studio::Rig rig = with_levels(setting.variables, places, levels);
  if (lux_at_face(setting.studio, rig, *key) >= lux_at_face(setting.studio, rig, *fill))
    return found;
  const Found other =
      polish(setting, {{swapped(setting.variables, found.point, *key, *fill), found.cost}}, options,
             watch);
  return other.cost <= kSwapPrice * found.cost ? other : found;
}

studio::Rig without_idle_lamps(const Setting& setting, studio::Rig rig) {
  const auto& lit = setting.variables.lit;
  if (lit.empty()) return rig;
  Workspace workspace(setting);
  Columns columns = workspace.columns(rig);
  Levels best = workspace.solver().solve(columns, Effort::thorough);
  const bool grey =
      setting.target.kind != Target::Kind::ideal && setting.target.kind != Target::Kind::perceptual;
  const double most = kIdle * best.cost + (grey ? kUnseenGrey : kUnseenCost);
  std::vector<std::size_t> order(lit.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return best.values[a] / columns.bounds[a].most < best.values[b] / columns.bounds[b].most;
  });
  for (const std::size_t k : order) {
    const core::Range bounds = columns.bounds[k];
    columns.bounds[k] = {0, 0};
    const Levels without = workspace.solver().solve(columns, Effort::thorough);
    if (without.cost <= most)
      best = without;
    else
      columns.bounds[k] = bounds;
  }
  return with_levels(setting.variables, std::move(rig), best.values);
}

studio::Rig with_dark_lamps_unmoved(const Setting& setting, studio::Rig rig,
                                    const studio::Rig& placed) {
  for (const std::size_t fixture : setting.variables.lit) {
    if (rig.states[fixture].get(core::Dof::intensity) > 0) continue;
    studio::Rig there = rig;
    there.states[fixture] = placed.states[fixture];
    there.states[fixture].set(core::Dof::intensity, 0);
    if (setting.layers.infeasible(there, fixture).empty()) rig = std::move(there);
  }
  return rig;
}

}  // namespace chiaro::design
