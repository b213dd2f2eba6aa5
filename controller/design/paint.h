// SPDX-License-Identifier: Apache-2.0
// Painting with light (Schoeneman and others 1993): a person paints regions of the predicted
// picture lighter, darker, warmer or cooler, and the lamps are solved for what was painted.
#pragma once

#include <vector>

#include "controller/design/design.h"
#include "controller/design/region.h"

namespace chiaro::design {

struct Stroke {
  Region region;
  double stops = 0;     ///< + lighter
  double mired = 0;     ///< + warmer
  double strength = 1;  ///< 1: the region counts as much as all the rest of the picture
};

/// The predicted picture of `rig` with the strokes laid over it, as an example to be followed pixel
/// by pixel. `hold`: how much the rest must stay as it is, 1 = as much as a stroke counts, 0 = it
/// may change. Without strokes and with a hold of 0 it asks for nothing.
ExampleGoal painted(const studio::Studio& studio, const LayersSource& twin, const studio::Rig& rig,
                    const std::vector<Stroke>& strokes, double hold, core::Size size);

}  // namespace chiaro::design
