// SPDX-License-Identifier: Apache-2.0
// The sensor between the light and the picture: shot noise, which grows with the light's root, and
// read noise, which is always there.
#pragma once

#include <cstdint>

#include "controller/core/picture.h"

namespace chiaro::simulator {

/// In electrons at the pixel. The defaults are a small studio camera at base ISO.
struct Sensor {
  double full_well = 12000;  ///< collected at linear value 1, where the camera clips
  double read_noise = 6;
  bool on = true;
};

/// The standard deviation that a linear value is read with.
double noise_at(const Sensor& sensor, double linear);

/// As the camera delivers it: clipped, noisy, 8-bit sRGB. The same seed and frame number give the
/// same bits.
core::EncodedPicture exposed(const core::Picture& linear, const Sensor& sensor, std::uint64_t seed,
                             std::uint64_t frame);

}  // namespace chiaro::simulator
