// SPDX-License-Identifier: Apache-2.0
// The program chiaro-draw: makes the shipped moods' pictures and targets from their recipes, and
// the bust from its model. Everything it writes can be thrown away and drawn again.
#pragma once

#include <string>
#include <vector>

#include "controller/measure/measure.h"
#include "controller/ports/world.h"
#include "simulator/moods/mood_file.h"
#include "simulator/moods/studio_set.h"
#include "simulator/path_tracer/path_tracer.h"

namespace chiaro::simulator {

ports::Exit run_draw(const std::vector<std::string>& arguments, ports::World& world);

struct DrawnMood {
  core::EncodedPicture picture;
  Measured measured;  ///< of the 3D exemplar: a clean 256 x 256 picture without antialiasing
  double noise = 0;   ///< root mean square error of the picture's linear luminance
};
/// Smaller than the camera's picture: it is a reference to look at, and it is shipped.
inline constexpr core::Size kDrawnSize{480, 360};
DrawnMood drawn(const StudioSet& set, core::Size size, const TraceOptions& options);

}  // namespace chiaro::simulator
