// SPDX-License-Identifier: Apache-2.0
// A recipe set up for the camera: its studio with the sitter turned and the walls painted, and its
// lamps as lights of the right strength.
#pragma once

#include "controller/core/result.h"
#include "controller/studio/load.h"
#include "controller/twin/scene.h"
#include "simulator/moods/recipe.h"

namespace chiaro::simulator {

struct StudioSet {
  studio::Studio studio;  ///< without fixtures: the recipe's lamps are in `scene`
  twin::Scene scene;      ///< lights in the recipe's order, levels all 1
  std::size_t key = 0;    ///< whose cast shadows count as shadow
};

/// `cache`: for the prepared mesh, empty = none.
core::Result<StudioSet> set_up(const Recipe& recipe, const studio::Folders& folders,
                               const std::filesystem::path& cache);

/// Candela with which a light of that shape and place gives `lux` on a surface at `target` that
/// faces it.
double candela_for(const twin::Light& light, core::Vec3 target, double lux);

}  // namespace chiaro::simulator
