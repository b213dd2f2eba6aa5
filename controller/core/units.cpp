// SPDX-License-Identifier: Apache-2.0
#include "controller/core/units.h"

#include <cmath>

namespace chiaro::core {

double from_stops(double stops) { return std::exp2(stops); }
double to_stops(double ratio) { return std::log2(ratio); }

}  // namespace chiaro::core
