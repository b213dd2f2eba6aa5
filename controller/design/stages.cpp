// SPDX-License-Identifier: Apache-2.0
#include "controller/design/stages.h"

#include <algorithm>
#include <cmath>

#include "controller/design/asked.h"
#include "controller/design/colours.h"
#include "controller/design/ideal.h"
#include "controller/design/roles.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

bool is_ideal(const Goal& goal) { return std::holds_alternative<IdealGoal>(goal); }

/// Components are the same whichever side, or from below, the light comes: only a picture that is
/// compared place by place tells.
bool tells_directions(const Goal& goal) {
  const auto* example = std::get_if<ExampleGoal>(&goal);
  return example != nullptr && example->objective != Objective::perceptual;
}

/// The thesis keeps the key to the quarter sphere in front and above [I-5]. A region that lies
/// wholly elsewhere stays as it is: its owner knows why.
core::Range in_front_and_above(const Variable& variable) {
  core::Range quarter = variable.range;
  if (variable.dof == core::Dof::elevation) quarter = {0, core::kPi / 2};
  if (variable.dof == core::Dof::azimuth) quarter = {-core::kPi / 2, core::kPi / 2};
  const core::Range both{std::max(variable.range.least, quarter.least),
                         std::min(variable.range.most, quarter.most)};
  return both.width() > 0 ? both : variable.range;
}

/// The same lamps, standing still as in `rig`.
Variables still(const Variables& all, const studio::Rig& rig) {
  Variables variables = all;
  variables.base = rig;
  variables.moving.clear();
  return variables;
}

Setting setting_of(const studio::Studio& studio, const Prepared& prepared,
                   const Variables& variables, Accuracy accuracy) {
  return {studio, prepared.layers, variables, prepared.target, prepared.map, accuracy};
}

studio::Rig with_solved_levels(const Setting& setting, const studio::Rig& rig) {
  if (setting.variables.lit.empty()) return rig;
  return with_levels(setting.variables, rig,
                     Workspace(setting).solve(rig, Effort::thorough).levels);
}

/// Flash power is set in thirds of a stop: those lamps take the nearest, the others make up for it.
studio::Rig with_flash_steps(const Setting& setting, studio::Rig rig) {
  Variables others = setting.variables;
  others.lit.clear();
  others.limits.clear();
  for (std::size_t k = 0; k < setting.variables.lit.size(); ++k) {
    const std::size_t fixture = setting.variables.lit[k];
    if (!is_flash(setting.studio.fixtures[fixture])) {
      others.lit.push_back(fixture);
      others.limits.push_back(setting.variables.limits[k]);
      continue;
    }
    const double level = rig.states[fixture].get(core::Dof::intensity);
    if (level > 0)
      rig.states[fixture].set(core::Dof::intensity,
                              std::exp2(std::min(0.0, std::round(3 * std::log2(level)) / 3)));
    others.held.push_back(fixture);
  }
  if (others.lit.size() == setting.variables.lit.size()) return rig;
  std::sort(others.held.begin(), others.held.end());
  others.base = rig;
  return with_solved_levels(
      {setting.studio, setting.layers, others, setting.target, setting.map, setting.accuracy}, rig);
}

studio::Rig by_example(const Setting& setting, const studio::Rig& placements) {
  const studio::Rig lit = without_idle_lamps(setting, placements);
  const studio::Rig coloured = with_colours(setting, lit);
  if (coloured == lit) return with_flash_steps(setting, lit);
  return with_flash_steps(setting, without_idle_lamps(setting, coloured));
}

Prepared prepared(const Layers& layers, const Goal& goal) {
  Prepared result{layers, target_of(goal, layers.size(), layers.geometry()), {}};
  result.map = map_for(layers, result.target);
  return result;
}

std::shared_ptr<const Asked> asked_beside(const Prepared& prepared,
                                          const std::shared_ptr<const Wishes>& wishes,
                                          const studio::Studio& studio, const Goal& goal) {
  auto asked = asked_of(wishes, studio, prepared.layers, goal);
  for (Asked::Side& side : asked->sides) side.target.ideal = prepared.target.ideal;
  return asked;
}

double placed_gradient(const studio::Studio& studio, const Prepared& at, const Variables& shape) {
  if (shape.lit.empty()) return 0;
  const std::size_t lamp = key_of(studio).value_or(shape.lit.front());
  core::FixtureState state = shape.base.states[lamp];
  state.set(core::Dof::intensity, 1);
  core::Plane light(at.layers.size());
  at.layers.luminance(lamp, state, Accuracy::exact, light);
  return measure::components_of_luminance(light, at.map).gradient;
}

}  // namespace

Variables searched(const studio::Studio& studio, const Variables& all, const Goal& goal) {
  Variables lamps = is_ideal(goal) ? variables_of(studio, all, IdealStage::shape, all.base) : all;
  if (tells_directions(goal)) return lamps;
  for (Variable& variable : lamps.moving)
    if (studio.fixtures[variable.fixture].role == studio::Role::key)
      variable.range = in_front_and_above(variable);
  return lamps;
}

Sizes prepare(const studio::Studio& studio, const Goal& goal, const Variables& variables,
              const Layers& small, const Layers& middle, const Layers& full,
              std::shared_ptr<const Wishes> wishes) {
  Sizes sizes{prepared(small, goal), prepared(middle, goal), prepared(full, goal)};
  const auto with_wishes = [&] {
    for (Prepared* each : {&sizes.small, &sizes.middle, &sizes.full})
      if (wishes) each->target.asked = asked_beside(*each, wishes, studio, goal);
    return std::move(sizes);
  };
  if (!is_ideal(goal)) return with_wishes();
  const Variables shape = searched(studio, variables, goal);
  sizes.small.target.ideal =
      attainable_targets(setting_of(studio, sizes.small, shape, Accuracy::cached));
  const double there = placed_gradient(studio, sizes.small, shape);
  for (Prepared* each : {&sizes.middle, &sizes.full}) {
    each->target.ideal = sizes.small.target.ideal;
    // The gradient is per pixel: what the same light shows at the other size tells the scale.
    const double here = placed_gradient(studio, *each, shape);
    if (there > 0) each->target.ideal.gradient *= here / there;
  }
  return with_wishes();
}

studio::Rig completed(const studio::Studio& studio, const Sizes& sizes, const Variables& all,
                      const studio::Rig& placements, bool may_move_back, Watch& watch) {
  const Prepared& full = sizes.full;
  if (full.target.kind != Target::Kind::ideal) {
    watch.begin("colour", 0);
    const Variables lamps = still(all, placements);
    const Setting setting = setting_of(studio, full, lamps, Accuracy::exact);
    return with_dark_lamps_unmoved(setting, by_example(setting, placements),
                                   studio::placed_rig(studio));
  }
  watch.begin("back light", 0);
  Variables shape = variables_of(studio, all, IdealStage::shape, placements);
  shape.moving.clear();
  const Setting first = setting_of(studio, full, shape, Accuracy::exact);
  studio::Rig rig = with_flash_steps(first, with_solved_levels(first, shape.base));
  const Variables lamps = still(all, rig);
  const Setting after = setting_of(studio, sizes.middle, lamps, Accuracy::cached);
  rig = with_back_lights(after, std::move(rig), may_move_back);
  return with_background_lights(after, std::move(rig));
}

Variables judged(const studio::Studio& studio, const Target& target, const Variables& all,
                 const studio::Rig& rig) {
  if (target.kind != Target::Kind::ideal) return still(all, rig);
  Variables shape = variables_of(studio, all, IdealStage::shape, rig);
  shape.base = rig;
  shape.moving.clear();
  return shape;
}

}  // namespace chiaro::design
