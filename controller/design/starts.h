// SPDX-License-Identifier: Apache-2.0
// Where the search begins: good guesses are worth more than trials.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "controller/design/trial.h"
#include "controller/design/watch.h"

namespace chiaro::design {

struct Starts {
  std::vector<optimise::Point> points;  ///< best guess first
  std::uint64_t trials = 0;             ///< spent on finding them
};

/// A guess by name. It costs no trials; what it is worth the search finds out.
struct Guess {
  std::string_view name, summary;
  /// From where the lamps stand; that itself where the twin has no geometry to go by.
  optimise::Point (*from)(const Setting& setting, const optimise::Point& placed);
};
std::span<const Guess> guesses();

/// Points to begin from: first a greedy pursuit over a lattice of each lamp's region (each lamp in
/// turn, the others as found so far), then the base rig, then every guess that differs. The
/// optimiser tries each and goes on from those that measure best.
Starts starts_for(const Setting& setting, Workspaces& workspaces, int threads, Watch& watch);

/// Spherical k-means of the subject's normals: `count` unit directions, largest cluster first;
/// fewer when the subject shows fewer. Deterministic: the first centre faces the mean, each next is
/// the normal farthest from those chosen. `curved`: each normal weighs as much as the surface bends
/// there, so that features draw the light rather than flat parts.
std::vector<core::Vec3> facing_directions(const core::GeometryPlanes& planes, std::size_t count,
                                          bool curved = false);

/// Where azimuth, elevation and distance are measured from. Without the mesh the aim is estimated:
/// the subject's own when given, else at 80 % of its height, a bust's head.
core::AimFrame estimated_aim(const studio::Studio& studio);

}  // namespace chiaro::design
