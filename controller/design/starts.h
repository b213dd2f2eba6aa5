// SPDX-License-Identifier: Apache-2.0
// Where the search begins: good guesses are worth more than trials.
#pragma once

#include <vector>

#include "controller/design/trial.h"
#include "controller/design/watch.h"

namespace chiaro::design {

struct Starts {
  std::vector<optimise::Point> points;  ///< best guess first
  std::uint64_t trials = 0;             ///< spent on finding them
};

/// The base rig, a greedy pursuit over a lattice of each lamp's region (each lamp in turn, the
/// others as found so far), and lamps along the directions the subject's surfaces face most,
/// k-means of their normals [I-10].
Starts starts_for(const Setting& setting, Workspaces& workspaces, int threads, Watch& watch);

/// Spherical k-means of the subject's normals: `count` unit directions, largest cluster first;
/// fewer when the subject shows fewer. Deterministic: the first centre faces the mean, each next is
/// the normal farthest from those chosen.
std::vector<core::Vec3> facing_directions(const core::GeometryPlanes& planes, std::size_t count);

/// Where azimuth, elevation and distance are measured from. Without the mesh the aim is estimated:
/// the subject's own when given, else at 80 % of its height, a bust's head.
core::AimFrame estimated_aim(const studio::Studio& studio);

}  // namespace chiaro::design
