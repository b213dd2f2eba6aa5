// SPDX-License-Identifier: Apache-2.0
// Between two exemplars: a target that is part the one, part the other (Ha and Olivier, TPCG 2007).
#pragma once

#include "controller/design/design.h"

namespace chiaro::design {

/// 0 gives `from`, 1 gives `to`. Lightness is interpolated pixel by pixel, and with it every
/// wavelet coefficient, which is linear in lightness; colours are mixed as light and take that
/// lightness. Targets of 3D exemplars are interpolated where both have them. `to` is resized to
/// `from`'s central square. Objective and weights are `from`'s. Preconditions: 0 <= share <= 1,
/// neither picture empty.
ExampleGoal blended(const ExampleGoal& from, const ExampleGoal& to, double share);

}  // namespace chiaro::design
