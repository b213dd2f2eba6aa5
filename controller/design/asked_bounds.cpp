// SPDX-License-Identifier: Apache-2.0
// Bounds as lines through the levels: what each lamp gives and takes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/design/asked.h"
#include "controller/design/asked_levels.h"
#include "controller/design/starts.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::design {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Watts at full where the studio's circuits tell them for every lamp; else the output in candela
/// stands for them.
std::vector<double> power_of(const studio::Studio& studio) {
  std::vector<double> watts(studio.fixtures.size(), 0);
  for (const studio::Circuit& circuit : studio.circuits)
    for (const auto& load : circuit.loads) watts[load.fixture] = load.watts;
  bool known = true;
  for (std::size_t i = 0; i < watts.size(); ++i)
    known = known && (watts[i] > 0 || !studio.fixtures[i].controlled);
  for (std::size_t i = 0; i < watts.size(); ++i) {
    if (!studio.fixtures[i].controlled) watts[i] = 0;
    if (studio.fixtures[i].controlled && !known) watts[i] = studio.fixtures[i].output.value;
  }
  return watts;
}

/// limit_least <= constant + sum over lamps <= limit_most, with lamps that are held in `constant`.
LinearBound line(const std::vector<double>& per_lamp, const Variables& variables,
                 const studio::Rig& rig) {
  LinearBound bound;
  for (const std::size_t fixture : variables.lit) bound.per_level.push_back(per_lamp[fixture]);
  for (const std::size_t fixture : variables.held)
    bound.constant += per_lamp[fixture] * rig.states[fixture].get(core::Dof::intensity);
  return bound;
}

LinearBound linear(const Bound& bound, const studio::Studio& studio, const Variables& variables,
                   const studio::Rig& rig) {
  using enum Bound::Kind;
  const std::size_t lamps = studio.fixtures.size();
  std::vector<double> per_lamp(lamps, 0);
  const bool of_light = bound.kind == lux_at_least || bound.kind == lux_at_most;
  if (of_light)
    for (std::size_t i = 0; i < lamps; ++i) per_lamp[i] = lux_on_face(studio, rig, i);
  else if (bound.kind == power_at_most)
    per_lamp = power_of(studio);
  else
    per_lamp[studio.fixture_index(bound.lamp).value_or(0)] = 1;
  double whole = 1;
  if (bound.kind == power_at_most) {
    whole = 0;
    for (const double watts : per_lamp) whole += watts;
  }
  LinearBound out = line(per_lamp, variables, rig);
  if (of_light && studio.ambient) out.constant += studio.ambient->illuminance.value;
  const bool least = bound.kind == lux_at_least || bound.kind == level_at_least;
  out.least = least ? bound.limit : -kNone;
  out.most = least ? kNone : bound.limit * whole;
  return out;
}

}  // namespace

double lux_on_face(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture) {
  const core::AimFrame aim = estimated_aim(studio);
  const twin::Light light = twin::light(studio.fixtures[fixture], rig.states[fixture], aim,
                                        studio.exposure.white_balance);
  return core::luminance(light.colour) *
         twin::light_model(light.kind).irradiance(light, aim.origin, aim.towards_camera);
}

std::vector<LinearBound> linear_bounds(const Wishes& wishes, const studio::Studio& studio,
                                       const Variables& variables, const studio::Rig& rig) {
  std::vector<LinearBound> bounds;
  for (const Bound& bound : wishes.bounds) bounds.push_back(linear(bound, studio, variables, rig));
  return bounds;
}

studio::Rig within_bounds(const Wishes& wishes, const studio::Studio& studio,
                          const Variables& variables, studio::Rig rig) {
  Columns columns;
  columns.bounds = variables.limits;
  columns.linear = linear_bounds(wishes, studio, variables, rig);
  std::vector<double> levels;
  for (const std::size_t fixture : variables.lit)
    levels.push_back(rig.states[fixture].get(core::Dof::intensity));
  lay_on_bounds(columns, levels);
  return with_levels(variables, std::move(rig), levels);
}

}  // namespace chiaro::design
