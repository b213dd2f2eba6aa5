// SPDX-License-Identifier: Apache-2.0
#include "controller/design/starts.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace chiaro::design {
namespace {

constexpr int kRounds = 20;  // of k-means: plenty, it settles in five or six

double cost_of(const Setting& setting, Workspaces& workspaces, const optimise::Point& point) {
  auto workspace = workspaces.borrow();
  const double cost = workspace->solve(setting.variables.rig(point), Effort::quick).cost;
  workspaces.give_back(std::move(workspace));
  return cost;
}

/// Each lamp in turn goes to the best place of its lattice. The best of equals is the first, so
/// the answer does not depend on the number of threads.
optimise::Point pursuit(const Setting& setting, Workspaces& workspaces, optimise::Point point,
                        int threads, Watch& watch, std::uint64_t& trials) {
  tbb::task_arena arena(threads);
  for (const std::size_t fixture : setting.variables.movers()) {
    const auto candidates = lattice(setting.variables, fixture, point);
    std::vector<double> costs(candidates.size(), std::numeric_limits<double>::infinity());
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        if (!watch.over()) costs[i] = cost_of(setting, workspaces, candidates[i]);
      });
    });
    const auto best = std::min_element(costs.begin(), costs.end());
    if (std::isfinite(*best)) point = candidates[static_cast<std::size_t>(best - costs.begin())];
    trials += candidates.size();
  }
  return point;
}

core::Vec3 farthest_normal(const std::vector<core::Vec3>& normals,
                           const std::vector<core::Vec3>& centres) {
  double least = 2;
  core::Vec3 farthest = normals.front();
  for (const core::Vec3 n : normals) {
    double nearest = -2;
    for (const core::Vec3 c : centres) nearest = std::max(nearest, dot(n, c));
    if (nearest < least) {
      least = nearest;
      farthest = n;
    }
  }
  return farthest;
}

/// One round: normals join their nearest centre, centres move to the mean. Gives cluster weights.
std::vector<double> regroup(const std::vector<core::Vec3>& normals,
                            const std::vector<double>& weights, std::vector<core::Vec3>& centres) {
  std::vector<core::Vec3> sums(centres.size());
  std::vector<double> sizes(centres.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t c = 1; c < centres.size(); ++c)
      if (dot(normals[i], centres[c]) > dot(normals[i], centres[nearest])) nearest = c;
    sums[nearest] = sums[nearest] + weights[i] * normals[i];
    sizes[nearest] += weights[i];
  }
  for (std::size_t c = 0; c < centres.size(); ++c)
    if (length(sums[c]) > 0) centres[c] = unit(sums[c]);
  return sizes;
}

void stand(const Variables& variables, std::size_t fixture, double azimuth, double elevation,
           optimise::Point& point) {
  for (std::size_t i = 0; i < variables.moving.size(); ++i) {
    const Variable& variable = variables.moving[i];
    if (variable.fixture != fixture) continue;
    if (variable.dof == core::Dof::azimuth) point[i] = variable.range.clamp(azimuth);
    if (variable.dof == core::Dof::elevation) point[i] = variable.range.clamp(elevation);
  }
}

/// A lamp along each direction that surfaces face [I-10], as far as its region goes.
optimise::Point along(const Setting& setting, const optimise::Point& placed, bool curved) {
  optimise::Point point = placed;
  const core::GeometryPlanes* planes = setting.layers.geometry();
  const auto movers = setting.variables.movers();
  if (planes == nullptr) return point;
  const auto directions = facing_directions(*planes, movers.size(), curved);
  const core::AimFrame frame = estimated_aim(setting.studio);
  for (std::size_t m = 0; m < std::min(movers.size(), directions.size()); ++m) {
    const core::Spherical place = core::spherical(frame, frame.origin + directions[m]);
    stand(setting.variables, movers[m], place.azimuth, place.elevation, point);
  }
  return point;
}

optimise::Point along_normals(const Setting& setting, const optimise::Point& placed) {
  return along(setting, placed, false);
}
optimise::Point along_bends(const Setting& setting, const optimise::Point& placed) {
  return along(setting, placed, true);
}

/// What photographers begin with: the first lamp 45 degrees to the left and up, the next opposite
/// and lower, further ones wider and wider.
optimise::Point above_front(const Setting& setting, const optimise::Point& placed) {
  optimise::Point point = placed;
  double azimuth = -45, elevation = 45;
  for (const std::size_t fixture : setting.variables.movers()) {
    stand(setting.variables, fixture, core::radians(azimuth), core::radians(elevation), point);
    azimuth = azimuth < 0 ? -azimuth : -azimuth - 25;
    elevation = 20;
  }
  return point;
}

}  // namespace

core::AimFrame estimated_aim(const studio::Studio& studio) {
  core::Vec3 aim;
  if (!studio.subjects.empty()) {
    const studio::Subject& subject = studio.subjects.front();
    aim = subject.aim.value_or(subject.at + core::Vec3{0, 0, 0.8 * subject.height.value_or(0)});
  }
  return core::aim_frame(
      aim, studio.cameras.empty() ? aim + core::Vec3{0, -1, 0} : studio.main_camera().at);
}

std::span<const Guess> guesses() {
  static constexpr Guess kGuesses[] = {
      {"facing", "along what the surfaces face most, k-means of their normals", along_normals},
      {"bends", "the same, each normal weighed by the surface's bend", along_bends},
      {"above-front", "45 degrees aside and up, the next opposite and lower", above_front}};
  return kGuesses;
}

namespace {

/// How much the normal turns towards the right and the lower neighbour of the same subject.
double bend_at(const core::GeometryPlanes& planes, int x, int y) {
  const auto normal = [&](int i, int j) {
    return core::Vec3{planes.normal_x.at(i, j), planes.normal_y.at(i, j), planes.normal_z.at(i, j)};
  };
  double bend = 0;
  if (x + 1 < planes.subject.size.width && planes.subject.at(x + 1, y))
    bend += length(normal(x + 1, y) - normal(x, y));
  if (y + 1 < planes.subject.size.height && planes.subject.at(x, y + 1))
    bend += length(normal(x, y + 1) - normal(x, y));
  return bend;
}

}  // namespace

std::vector<core::Vec3> facing_directions(const core::GeometryPlanes& planes, std::size_t count,
                                          bool curved) {
  std::vector<core::Vec3> normals;
  std::vector<double> weights;
  core::Vec3 mean;
  for (int y = 0; y < planes.subject.size.height; ++y)
    for (int x = 0; x < planes.subject.size.width; ++x) {
      if (!planes.subject.at(x, y)) continue;
      normals.push_back(
          {planes.normal_x.at(x, y), planes.normal_y.at(x, y), planes.normal_z.at(x, y)});
      weights.push_back(curved ? bend_at(planes, x, y) : 1);
      mean = mean + weights.back() * normals.back();
    }
  if (normals.empty() || count == 0 || length(mean) == 0) return {};
  std::vector<core::Vec3> centres{unit(mean)};
  while (centres.size() < count) centres.push_back(farthest_normal(normals, centres));
  std::vector<double> sizes;
  for (int round = 0; round < kRounds; ++round) sizes = regroup(normals, weights, centres);
  std::vector<std::size_t> order(centres.size());
  for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<core::Vec3> directions;
  for (const std::size_t c : order) directions.push_back(centres[c]);
  return directions;
}

Starts starts_for(const Setting& setting, Workspaces& workspaces, int threads, Watch& watch) {
  Starts starts;
  const optimise::Point placed = setting.variables.point(setting.variables.base);
  const optimise::Point pursued =
      pursuit(setting, workspaces, placed, threads, watch, starts.trials);
  starts.points = {pursued};
  const auto add = [&](optimise::Point point) {
    if (std::find(starts.points.begin(), starts.points.end(), point) == starts.points.end())
      starts.points.push_back(std::move(point));
  };
  add(placed);
  for (const Guess& guess : guesses()) add(guess.from(setting, placed));
  return starts;
}

}  // namespace chiaro::design
