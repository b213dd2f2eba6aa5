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

/// One round: normals join their nearest centre, centres move to the mean. Gives cluster sizes.
std::vector<std::size_t> regroup(const std::vector<core::Vec3>& normals,
                                 std::vector<core::Vec3>& centres) {
  std::vector<core::Vec3> sums(centres.size());
  std::vector<std::size_t> sizes(centres.size());
  for (const core::Vec3 n : normals) {
    std::size_t nearest = 0;
    for (std::size_t c = 1; c < centres.size(); ++c)
      if (dot(n, centres[c]) > dot(n, centres[nearest])) nearest = c;
    sums[nearest] = sums[nearest] + n;
    ++sizes[nearest];
  }
  for (std::size_t c = 0; c < centres.size(); ++c)
    if (length(sums[c]) > 0) centres[c] = unit(sums[c]);
  return sizes;
}

/// Lamps along the facing directions, each direction given to the free lamp whose region is
/// nearest.
optimise::Point along_normals(const Setting& setting, optimise::Point point) {
  const core::GeometryPlanes* planes = setting.layers.geometry();
  const auto movers = setting.variables.movers();
  if (planes == nullptr) return point;
  const auto directions = facing_directions(*planes, movers.size());
  const core::AimFrame frame = estimated_aim(setting.studio);
  for (std::size_t m = 0; m < std::min(movers.size(), directions.size()); ++m) {
    const core::Spherical place = core::spherical(frame, frame.origin + directions[m]);
    for (std::size_t i = 0; i < setting.variables.moving.size(); ++i) {
      const Variable& variable = setting.variables.moving[i];
      if (variable.fixture != movers[m]) continue;
      if (variable.dof == core::Dof::azimuth) point[i] = variable.range.clamp(place.azimuth);
      if (variable.dof == core::Dof::elevation) point[i] = variable.range.clamp(place.elevation);
    }
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

std::vector<core::Vec3> facing_directions(const core::GeometryPlanes& planes, std::size_t count) {
  std::vector<core::Vec3> normals;
  core::Vec3 mean;
  for (std::size_t i = 0; i < planes.subject.values.size(); ++i) {
    if (!planes.subject.values[i]) continue;
    normals.push_back(
        {planes.normal_x.values[i], planes.normal_y.values[i], planes.normal_z.values[i]});
    mean = mean + normals.back();
  }
  if (normals.empty() || count == 0 || length(mean) == 0) return {};
  std::vector<core::Vec3> centres{unit(mean)};
  while (centres.size() < count) centres.push_back(farthest_normal(normals, centres));
  std::vector<std::size_t> sizes;
  for (int round = 0; round < kRounds; ++round) sizes = regroup(normals, centres);
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
  for (const auto& point : {pursued, placed, along_normals(setting, placed)})
    if (std::find(starts.points.begin(), starts.points.end(), point) == starts.points.end())
      starts.points.push_back(point);
  return starts;
}

}  // namespace chiaro::design
