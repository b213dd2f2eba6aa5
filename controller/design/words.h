// SPDX-License-Identifier: Apache-2.0
// Placements, levels and stops as the trade says them.
#pragma once

#include <string>

#include "controller/core/dof.h"
#include "controller/studio/studio.h"

namespace chiaro::design {

/// "1⅓ stops", "⅔ stop", "2 stops"; rounded to thirds, sign dropped.
std::string stops_in_words(double stops);
/// "full", "35 %", "1/4 power (2 stops below full)" is for flashes.
std::string level_in_words(double level);
std::string flash_power_in_words(double level);
/// A number without needless zeros: 1.6, 2, 0.45.
std::string number(double value, int decimals);

/// What one lamp of a rig alone gives a meter at the face, pointed at it.
double lux_at_face(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture);
/// "key to fill 4:1 (2 stops)"; the brighter one first; empty when either is missing or dark.
std::string ratio_in_words(const studio::Studio& studio, const studio::Rig& rig);

/// What a person must do to bring each lamp from `now` to `wanted`: stands to move, knobs, gels,
/// flash powers. What goes over a wire needs no person.
std::vector<std::string> instructions(const studio::Studio& studio, const studio::Rig& now,
                                      const studio::Rig& wanted);

}  // namespace chiaro::design
