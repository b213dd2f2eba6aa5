// SPDX-License-Identifier: Apache-2.0
// Numbers as a gaffer says them.
#pragma once

#include <optional>
#include <string>

#include "controller/core/geometry.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// "62 %, 0.7 stops below full", "full", "off".
std::string level_in_words(double intensity);
/// Below this nobody sees light: "off".
inline constexpr double kOff = 0.0005;
/// "4300 K", "4300 K, 8 towards green", "red 80 %, blue 20 %"; "" for a lamp of one colour.
std::string colour_in_words(const studio::Fixture& fixture, const core::FixtureState& state);
/// "4:1", "2.8:1".
std::string ratio_in_words(double ratio);
/// What a person does to the lamp itself: "set key to 1/4 power", "put ½ CTO (Lee 205) on key, for
/// 4300 K", "turn key's level to 62 %".
std::string hand_in_words(const studio::Fixture& fixture, const studio::HandBinding& binding,
                          double value);
/// The gel that turns one white into the other: "½ CTO (Lee 205)"; "" when none is needed.
std::string gel_in_words(double from_k, double to_k);
std::string_view mount_name(const studio::Mount& mount);
/// Where a lamp is, as seen from what it lights; for stands from their placement.
core::Spherical place_of(const studio::Studio& studio, const studio::Fixture& fixture,
                         const core::FixtureState& placed);

}  // namespace chiaro::daemon
