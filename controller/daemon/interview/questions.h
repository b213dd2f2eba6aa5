// SPDX-License-Identifier: Apache-2.0
// How each kind of answer is understood. Pure functions, so that each refusal can be tested.
#pragma once

#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/core/units.h"
#include "controller/daemon/interview/dialogue.h"
#include "controller/studio/reading/quantity.h"

namespace chiaro::daemon::interview {

/// A quantity within bounds, in inside units; people may leave out the unit where only one makes
/// sense at a terminal ("2.6" for metres).
Dialogue::Understand<double> a_quantity(studio::reading::Measure measure, core::Range bounds);
Dialogue::Understand<int> a_whole_number(int least, int most);
Dialogue::Understand<std::string> one_of(std::vector<std::string> words);
/// Letters, digits, '-', '_', '.', spaces, and none of `taken`.
Dialogue::Understand<std::string> a_name(std::vector<std::string> taken);
/// One line of text without control characters.
Dialogue::Understand<std::string> a_line();

}  // namespace chiaro::daemon::interview
