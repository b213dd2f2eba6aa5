// SPDX-License-Identifier: Apache-2.0
// What the panel and the design engine read of a drawn mood.
#pragma once

#include <string>

#include "controller/measure/measure.h"
#include "simulator/moods/recipe.h"

namespace chiaro::simulator {

/// The text of mood.yaml: the recipe's words, and what the clean picture measures.
std::string mood_yaml(const Recipe& recipe, const measure::Targets& targets);

}  // namespace chiaro::simulator
