// SPDX-License-Identifier: Apache-2.0
// What the panel and the design engine read of a drawn mood.
#pragma once

#include <optional>
#include <string>

#include "controller/measure/measure.h"
#include "simulator/moods/recipe.h"

namespace chiaro::simulator {

/// What the clean picture of a mood measures.
struct Measured {
  measure::Targets targets;
  /// What the front of the face gets, bounced light included, in stops from the camera's exposure
  /// (its grey_card); 0: an 18 % card there would be mid grey. Nothing without a face in view.
  std::optional<double> exposure_stops;
  core::Kelvin white_balance{5600};  ///< the camera's when it was drawn
};

/// The text of mood.yaml: the recipe's words, and what was measured.
std::string mood_yaml(const Recipe& recipe, const Measured& measured);

}  // namespace chiaro::simulator
