// SPDX-License-Identifier: Apache-2.0
// One look from a mood to light, as an operator would make it, through the daemon's API alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::daemon {

/// How the demo talks to the daemon, waits, and is stopped.
struct DemoLink {
  std::string daemon;  ///< "http://127.0.0.1:8090"
  /// Called between looks at the daemon; sleeps a little. A problem ends the waiting: a program
  /// has died for good, or the user wants to stop.
  std::function<core::Result<core::Done>()> wait;
  std::function<double()> seconds;  ///< monotonic
};

/// Until the daemon answers, its studio is prepared and the hand is connected.
core::Result<core::Done> wait_until_ready(const DemoLink& link, double patience_s);

/// Work light, so that there is a sitter to see, unless a look is live already.
core::Result<core::Done> light_to_begin_with(const DemoLink& link);

/// Where progress is told: on a terminal on one line that changes, else when the stage changes.
struct Teller {
  std::ostream& out;
  bool terminal = false;
};

struct MadeLook {
  std::string mood, title, verdict, remedy, ratio;
  std::vector<std::string> lamps;  ///< "key: 47° camera left, 38° up, 1.6 m · 62 % · 4300 K"
  std::uint64_t trials = 0;
  double design_s = 0;       ///< the design engine's own time
  double until_light_s = 0;  ///< from the wish to the last stand in place and the fade's end
  double difference = 0;     ///< preview against camera, mean difference in L*
  core::EncodedPicture reference, preview, camera;
};
/// Designs the mood, applies it with a fade of `fade_s`, waits until every stand stands and the
/// light has settled, and takes the camera's picture.
core::Result<MadeLook> make_look(const DemoLink& link, const std::string& mood, double fade_s,
                                 Teller tell);

/// The middle of the picture in the shape (width to height) `aspect`.
core::EncodedPicture cropped(const core::EncodedPicture& picture, double aspect);
/// Mean difference in lightness, 0..100, of what both show: the middle, at the smaller's size.
double lightness_difference(const core::EncodedPicture& a, const core::EncodedPicture& b);
/// Reference, preview and camera beside each other, of one height and shape.
core::EncodedPicture side_by_side(const MadeLook& look);
/// As people read it, and as one JSON object.
std::string in_words(const MadeLook& look, const std::filesystem::path& picture);
std::string in_json(const MadeLook& look, const std::filesystem::path& picture);

}  // namespace chiaro::daemon
