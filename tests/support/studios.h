// SPDX-License-Identifier: Apache-2.0
// Small studios for tests, made by the same reader that makes the user's.
#pragma once

#include <string>

#include "controller/rig/governor.h"
#include "controller/studio/studio.h"

namespace chiaro::support {

/// The smallest valid studio file around these fixtures: `fixtures` is the YAML below `fixtures:`,
/// indented by two; universes 1 and 2 go out by sACN on "lo" at 40 Hz. `more` is added at the end.
std::string studio_text(const std::string& fixtures, const std::string& more = "");
/// One fixture's line: a fixed lamp of that profile and mode.
std::string fixture_line(const std::string& name, const std::string& profile,
                         const std::string& mode, int universe, int address,
                         const std::string& more = "");
/// Reads it; a text with problems is a bug of the test and throws with all of them.
studio::Studio studio_from(const std::string& text);

/// The states as levels that may be encoded, said at once by a person's hand. They stay valid as
/// long as the governor.
const rig::AllowedLevels& allow(rig::Governor& governor, const studio::Studio& studio,
                                const std::vector<core::FixtureState>& states,
                                ports::TimePoint now);

}  // namespace chiaro::support
