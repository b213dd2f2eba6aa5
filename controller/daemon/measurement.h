// SPDX-License-Identifier: Apache-2.0
// What `chiaro measure` tells of one picture, for people and for scripts.
#pragma once

#include <string>

#include "controller/core/picture.h"
#include "controller/measure/measure.h"

namespace chiaro::daemon {

struct Measurement {
  core::Size size;
  bool geometry = false;  ///< edge and contrast mean something
  bool shadow = false;    ///< the key's cast shadow was known
  measure::Components components;
  measure::HaarSpectrum spectrum;
  double black = 0, clipped = 0;  ///< shares of pixels at either end of the picture's range
};

/// `picture` is display-linear, of the map's size; `lit` may be null.
Measurement measurement(const core::Picture& picture, const measure::PixelMap& map,
                        const core::Plane* lit);

std::string to_text(const std::string& picture, const std::string& studio, const Measurement& m);
std::string to_json(const std::string& picture, const std::string& studio, const Measurement& m);

}  // namespace chiaro::daemon
