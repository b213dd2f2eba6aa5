// SPDX-License-Identifier: Apache-2.0
#include "controller/design/variables.h"

#include <algorithm>

#include "controller/design/starts.h"
#include "controller/twin/aim.h"

namespace chiaro::design {
namespace {

constexpr int kAzimuths = 6, kElevations = 4;

double between(core::Range range, int step, int steps) {
  return range.least + range.width() * (step + 0.5) / steps;
}

/// Every number of a place is free, or fixed where its range has no width [I-1].
void add_placement(Variables& variables, std::size_t fixture, const studio::Region& region) {
  const auto add = [&](core::Dof dof, core::Range range) {
    if (range.width() > 0) variables.moving.push_back({fixture, dof, range});
  };
  add(core::Dof::azimuth, region.azimuth);
  add(core::Dof::elevation, region.elevation);
  add(core::Dof::distance, region.distance);
}

/// A head is searched about the subject only: most of what it could point at is the room.
core::Range near_aim(double aimed, core::Range reach) {
  const double window = core::radians(20);
  return {reach.clamp(aimed - window), reach.clamp(aimed + window)};
}

/// What motors move: along arcs and tracks, and heads about where they point at the subject.
void add_motors(Variables& variables, std::size_t index, const studio::Studio& studio) {
  const studio::Fixture& fixture = studio.fixtures[index];
  const auto ranges = fixture.ranges();
  const auto range_of = [&](core::Dof dof) {
    for (const auto& [each, range] : ranges)
      if (each == dof) return range;
    return core::Range{0, 0};
  };
  const auto add = [&](core::Dof dof, core::Range range) {
    if (range.width() > 0) variables.moving.push_back({index, dof, range});
  };
  add(core::Dof::arc, range_of(core::Dof::arc));
  add(core::Dof::track, range_of(core::Dof::track));
  const auto* head = std::get_if<studio::PanTiltMount>(&fixture.mount);
  if (head == nullptr) return;
  const core::Range pan = range_of(core::Dof::pan), tilt = range_of(core::Dof::tilt);
  const core::FixtureState& now = variables.base.states[index];
  const auto aimed = twin::aimed_at(*head, pan, tilt, estimated_aim(studio).origin,
                                    {now.get(core::Dof::pan), now.get(core::Dof::tilt)});
  if (!aimed) return;
  add(core::Dof::pan, near_aim(aimed->pan, pan));
  add(core::Dof::tilt, near_aim(aimed->tilt, tilt));
}

bool is_locked(const Options& options, const std::string& name) {
  return std::find(options.locked.begin(), options.locked.end(), name) != options.locked.end();
}

}  // namespace

std::vector<core::Range> Variables::bounds() const {
  std::vector<core::Range> bounds;
  for (const Variable& variable : moving) bounds.push_back(variable.range);
  return bounds;
}

studio::Rig Variables::rig(std::span<const double> point) const {
  studio::Rig rig = base;
  for (std::size_t i = 0; i < moving.size(); ++i)
    rig.states[moving[i].fixture].set(moving[i].dof, point[i]);
  return rig;
}

optimise::Point Variables::point(const studio::Rig& rig) const {
  optimise::Point point;
  for (const Variable& variable : moving) {
    const double otherwise = (variable.range.least + variable.range.most) / 2;
    point.push_back(
        variable.range.clamp(rig.states[variable.fixture].get(variable.dof, otherwise)));
  }
  return point;
}

std::vector<std::size_t> Variables::movers() const {
  std::vector<std::size_t> fixtures;
  for (const Variable& variable : moving)
    if (fixtures.empty() || fixtures.back() != variable.fixture)
      fixtures.push_back(variable.fixture);
  return fixtures;
}

std::vector<optimise::Point> lattice(const Variables& variables, std::size_t fixture,
                                     const optimise::Point& from) {
  std::vector<optimise::Point> points;
  for (int a = 0; a < kAzimuths; ++a)
    for (int e = 0; e < kElevations; ++e) {
      optimise::Point point = from;
      for (std::size_t i = 0; i < variables.moving.size(); ++i) {
        const Variable& variable = variables.moving[i];
        if (variable.fixture != fixture) continue;
        if (variable.dof == core::Dof::azimuth) point[i] = between(variable.range, a, kAzimuths);
        if (variable.dof == core::Dof::elevation)
          point[i] = between(variable.range, e, kElevations);
      }
      if (std::find(points.begin(), points.end(), point) == points.end())
        points.push_back(std::move(point));
    }
  return points;
}

const studio::Region* region_of(const studio::Fixture& fixture) {
  if (const auto* stand = std::get_if<studio::StandMount>(&fixture.mount)) return &stand->region;
  if (const auto* free = std::get_if<studio::VirtualMount>(&fixture.mount)) return &free->region;
  return nullptr;
}

/// All lamps jointly, however many there are [I-3].
Variables variables_of(const studio::Studio& studio, const Options& options) {
  Variables variables;
  variables.base = options.start ? *options.start : studio::placed_rig(studio);
  variables.glasses = options.glasses;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const studio::Fixture& fixture = studio.fixtures[i];
    if (!fixture.controlled || is_locked(options, fixture.name)) {
      variables.held.push_back(i);
      continue;
    }
    variables.lit.push_back(i);
    variables.limits.push_back({0, fixture.limits.most});
    const studio::Region* region = region_of(fixture);
    if (region != nullptr && options.move_stands) add_placement(variables, i, *region);
    if (options.move_stands) add_motors(variables, i, studio);
  }
  return variables;
}

core::Problems problems_of(const studio::Studio& studio, const Options& options) {
  core::Problems problems;
  std::vector<std::string> names;
  for (const auto& fixture : studio.fixtures) names.push_back(fixture.name);
  for (const std::string& name : options.locked) {
    if (studio.fixture_index(name)) continue;
    const std::string near = core::nearest_name(name, names);
    std::string known;
    for (const auto& each : names) known += (known.empty() ? "" : ", ") + each;
    problems.push_back(
        {{studio.file.string()},
         "cannot lock \"" + name + "\": the studio has no such fixture",
         (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "its fixtures are: " + known});
  }
  if (!optimise::make_optimiser(options.optimiser)) {
    std::vector<std::string> known;
    std::string list;
    for (const auto& entry : optimise::optimisers()) {
      known.emplace_back(entry.name);
      list += (list.empty() ? "" : ", ") + known.back();
    }
    const std::string near = core::nearest_name(options.optimiser, known);
    problems.push_back(
        {{},
         "no optimiser is called \"" + options.optimiser + "\"",
         (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "there are: " + list});
  }
  for (const core::Size size : {options.search_size, options.polish_size, options.full_size})
    if (size.width != size.height || size.width < 8 || (size.width & (size.width - 1)) != 0)
      problems.push_back({{},
                          "a design works on squares of 8, 16, 32 … pixels, not " +
                              std::to_string(size.width) + " x " + std::to_string(size.height),
                          "ask for 64, 128 or 256"});
  if (options.start && options.start->states.size() != studio.fixtures.size())
    problems.push_back({{},
                        "the starting look has " + std::to_string(options.start->states.size()) +
                            " fixtures, the studio " + std::to_string(studio.fixtures.size()),
                        "design without it: the studio has changed since"});
  return problems;
}

}  // namespace chiaro::design
