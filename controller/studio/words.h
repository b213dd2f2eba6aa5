// SPDX-License-Identifier: Apache-2.0
// The studio in the trade's words: "47° camera left, 38° up, 1.6 m". For patch sheets, verdicts
// and instructions; programs read the values themselves.
#pragma once

#include <string>

#include "controller/studio/studio.h"

namespace chiaro::studio {

/// "47° camera left, 38° up, 1.6 m"; behind the subject it says so.
std::string place_in_words(const core::Spherical& place);
/// And back, as people type it: "47 left, 38 up, 1.6 m", "47° camera left, level, 160 cm",
/// "straight behind, 30 up, 2 m". The problem is one sentence that says what is missing.
core::Result<core::Spherical> place_from_words(const std::string& words);
/// The kind of mount: "stand", "fixed", "moving head".
std::string_view name_of(const Mount& mount);
/// "1.001-004" as patch sheets print it, "bus rail: 40-41", or "by hand".
std::string patch_in_words(const Fixture& fixture);
/// "softbox 0.6 x 0.9 m, 5686 cd": what is fitted and what comes out of it.
std::string output_in_words(const Fixture& fixture);
/// "at most 80 %, safe at 10 %, house light"; "none" when there are none.
std::string limits_in_words(const Limits& limits);
/// What a person sets: "intensity by knob"; empty when nothing but the stand.
std::string by_hand_in_words(const Fixture& fixture);
std::string_view name_of(HandKind kind);

}  // namespace chiaro::studio
