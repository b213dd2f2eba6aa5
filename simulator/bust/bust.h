// SPDX-License-Identifier: Apache-2.0
// The sitter nobody has to be asked: a head with neck and shoulders, modelled by us as a signed
// distance, so that it may be shipped. It is what the moods show and what stands in for a person.
#pragma once

#include "controller/core/geometry.h"

namespace chiaro::simulator {

/// Signed distance in metres, negative inside; near the surface within a few per cent of true.
/// Model frame: Z up, the face looks along -Y, the cut base lies in z = 0, x = 0 is the middle.
/// Real size: crown at about 0.62 m, pupils at kEyeHeight.
double bust_distance(core::Vec3 p);
/// Unit, outward.
core::Vec3 bust_normal(core::Vec3 p);

/// Metres above the base.
inline constexpr double kEyeHeight = 0.4992;
inline constexpr double kBustHeight = 0.62;

}  // namespace chiaro::simulator
