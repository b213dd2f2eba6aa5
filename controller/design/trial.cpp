// SPDX-License-Identifier: Apache-2.0
#include "controller/design/trial.h"

#include <algorithm>

#include "controller/design/asked.h"
#include "controller/design/comfort.h"

namespace chiaro::design {
namespace {

constexpr double kHabit = 0.02;
constexpr double kGlare = 0.5;  // of the cost, were all the light in the glasses

/// A state without its level: what a layer depends on.
core::FixtureState at_full(core::FixtureState state) {
  state.set(core::Dof::intensity, 1);
  return state;
}

/// How far lamps are from where portraits usually have them, as a share of the cost. Another face
/// says only so much about where its light came from: of places that fit alike the usual one wins.
double unusual(const studio::Studio& studio, const studio::Rig& rig) {
  double key_side = 0, sum = 0;
  const auto off = [&](std::size_t i, core::Dof dof, double usual_deg, double spread_deg) {
    const double d = (core::degrees(rig.states[i].get(dof)) - usual_deg) / spread_deg;
    return d * d;
  };
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].role == studio::Role::key && rig.states[i].has(core::Dof::azimuth)) {
      key_side = rig.states[i].get(core::Dof::azimuth) < 0 ? -1 : 1;
      sum += off(i, core::Dof::elevation, 42, 18);  // "45° up", say the books
    }
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].role == studio::Role::fill && rig.states[i].has(core::Dof::azimuth))
      sum += off(i, core::Dof::elevation, 10, 15) + off(i, core::Dof::azimuth, -25 * key_side, 30);
  return kHabit * sum;
}

}  // namespace

std::optional<std::size_t> key_of(const studio::Studio& studio) {
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i)
    if (studio.fixtures[i].role == studio::Role::key) return i;
  return std::nullopt;
}

measure::PixelMap map_for(const Layers& layers, const Target& target) {
  const core::GeometryPlanes* planes = layers.geometry();
  return target.by_geometry && planes != nullptr ? measure::pixel_map(*planes)
                                                 : measure::flat_pixel_map(layers.size());
}

Workspace::Workspace(const Setting& setting)
    : setting_(setting),
      movers_(setting.variables.movers()),
      planes_(setting.variables.lit.size(), core::Plane(setting.layers.size())),
      known_(setting.variables.lit.size()),
      solver_(level_solver(setting.target, setting.map)) {
  // By example the exemplar's own shadows are part of its components, so ours stay in too.
  if (setting.target.kind == Target::Kind::ideal) key_ = key_of(setting.studio);
  columns_.bounds = setting.variables.limits;
  for (const core::Plane& plane : planes_) columns_.planes.push_back(&plane);
  columns_.offset = &offset_;
  if (key_) {
    lit_ = core::Plane(setting.layers.size());
    columns_.lit = &lit_;
  }
  if (setting.target.asked) asked_ = std::make_unique<AskedOfPlaces>(setting);
}

Workspace::~Workspace() = default;

void Workspace::fetch(const studio::Rig& rig, std::size_t fixture, core::Plane& plane,
                      core::FixtureState& known) {
  const core::FixtureState wanted = at_full(rig.states[fixture]);
  if (wanted == known) return;
  if (key_ == fixture && !(wanted == key_known_)) {
    setting_.layers.luminance_and_visibility(fixture, wanted, setting_.accuracy, plane, lit_);
    key_known_ = wanted;
  } else {
    setting_.layers.luminance(fixture, wanted, setting_.accuracy, plane);
  }
  known = wanted;
}

/// For a key whose level is not solved: others brought theirs with their layers.
void Workspace::fetch_shadows(const studio::Rig& rig) {
  if (!key_) return;
  const core::FixtureState wanted = at_full(rig.states[*key_]);
  if (wanted == key_known_) return;
  setting_.layers.visibility(*key_, wanted, setting_.accuracy, lit_);
  key_known_ = wanted;
}

void Workspace::fetch_offset(const studio::Rig& rig) {
  std::vector<core::FixtureState> held;
  for (const std::size_t fixture : setting_.variables.held)
    if (setting_.studio.fixtures[fixture].controlled) held.push_back(rig.states[fixture]);
  if (!offset_.empty() && held == held_) return;
  offset_ = core::luminance(setting_.layers.ambient());
  core::Plane plane(setting_.layers.size());
  for (const std::size_t fixture : setting_.variables.held) {
    const double level = rig.states[fixture].get(core::Dof::intensity);
    // Uncontrolled practicals are in the twin's ambient layer already.
    if (!setting_.studio.fixtures[fixture].controlled || level == 0) continue;
    setting_.layers.luminance(fixture, at_full(rig.states[fixture]), setting_.accuracy, plane);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
      offset_.values[i] += static_cast<float>(level) * plane.values[i];
  }
  held_ = std::move(held);
}

const Columns& Workspace::columns(const studio::Rig& rig) {
  const auto& lit = setting_.variables.lit;
  for (std::size_t k = 0; k < lit.size(); ++k) fetch(rig, lit[k], planes_[k], known_[k]);
  fetch_offset(rig);
  fetch_shadows(rig);
  if (asked_) asked_->update(rig, columns_);
  return columns_;
}

bool Workspace::feasible(const studio::Rig& rig) const {
  return std::all_of(movers_.begin(), movers_.end(), [&](std::size_t fixture) {
    return setting_.layers.infeasible(rig, fixture).empty();
  });
}

Workspace::Scored Workspace::solve(const studio::Rig& rig, Effort effort) {
  if (!feasible(rig)) return {};
  Levels levels = solver_->solve(columns(rig), effort);
  if (setting_.target.kind == Target::Kind::pattern)
    levels.cost *= 1 + unusual(setting_.studio, rig);
  if (setting_.variables.glasses)
    levels.cost *= 1 + kGlare * glare_share(setting_.studio,
                                            with_levels(setting_.variables, rig, levels.values));
  return {levels.cost, std::move(levels.values)};
}

Workspace::Scored Workspace::score(const studio::Rig& rig) {
  if (!feasible(rig)) return {};
  std::vector<double> levels;
  for (const std::size_t fixture : setting_.variables.lit)
    levels.push_back(rig.states[fixture].get(core::Dof::intensity));
  const double cost = solver_->cost(columns(rig), levels);
  return {cost, std::move(levels)};
}

std::unique_ptr<Workspace> Workspaces::borrow() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto workspace = std::move(idle_.back());
      idle_.pop_back();
      return workspace;
    }
  }
  return std::make_unique<Workspace>(setting_);
}

void Workspaces::give_back(std::unique_ptr<Workspace> workspace) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(workspace));
}

studio::Rig with_levels(const Variables& variables, studio::Rig rig,
                        std::span<const double> levels) {
  for (std::size_t k = 0; k < variables.lit.size(); ++k)
    rig.states[variables.lit[k]].set(core::Dof::intensity, levels[k]);
  return rig;
}

}  // namespace chiaro::design
