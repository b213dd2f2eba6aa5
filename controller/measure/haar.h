// SPDX-License-Identifier: Apache-2.0
// How the Haar levels weigh in the wavelet distance; shared by the distance and its Gram form.
#pragma once

namespace chiaro::measure {

/// Levels of a square of that side: log2(side). Precondition: a power of two from 2 on.
int haar_levels(int side);
/// The mean's and each coefficient's weight in the squared distance.
double haar_mean_weight(int side);
double haar_level_weight(int side, int level);

}  // namespace chiaro::measure
