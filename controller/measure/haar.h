// SPDX-License-Identifier: Apache-2.0
// The Haar spectrum as one array, its coefficients scaled so that the plain squared distance of two
// arrays is the squared wavelet distance: what the Gram forms are built from.
#pragma once

#include <vector>

#include "controller/core/picture.h"

namespace chiaro::measure {

/// Levels of a square of that side: log2(side). Precondition: a power of two from 2 on.
int haar_levels(int side);
/// The mean's and each coefficient's weight in the squared distance.
double haar_mean_weight(int side);
double haar_level_weight(int side, int level);

/// Scaled coefficients of a square plane whose side is a power of two: mean, then per level from
/// the whole square down h and v. side * side * 2 / 3 numbers or so.
std::vector<float> scaled_haar(const core::Plane& values);

}  // namespace chiaro::measure
