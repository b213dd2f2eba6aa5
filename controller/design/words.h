// SPDX-License-Identifier: Apache-2.0
// Placements, levels and stops as the trade says them.
#pragma once

#include <string>

#include "controller/core/dof.h"
#include "controller/core/light_units.h"
#include "controller/studio/studio.h"

namespace chiaro::design {

// The trade's words live in core; the stages speak them unqualified.
using core::flash_power_in_words;
using core::level_in_words;
using core::number;
using core::ratio_in_words;
using core::stops_in_words;

/// What one lamp of a rig alone gives a meter at the face, pointed at it.
double lux_at_face(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture);
/// "key to fill 4:1 (2 stops)"; the brighter one first; empty when either is missing or dark.
std::string ratio_in_words(const studio::Studio& studio, const studio::Rig& rig);

bool is_flash(const studio::Fixture& fixture);
/// A flash gives its light whatever the shutter, a lamp that burns does not: why a rig with both
/// lit needs care, with what to do; empty when only one kind is lit.
std::string mixed_light_in_words(const studio::Studio& studio, const studio::Rig& rig);

/// What a person must do to bring each lamp from `now` to `wanted`: stands to move, knobs, gels,
/// flash powers. What goes over a wire needs no person.
std::vector<std::string> instructions(const studio::Studio& studio, const studio::Rig& now,
                                      const studio::Rig& wanted);

}  // namespace chiaro::design
