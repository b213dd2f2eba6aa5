// SPDX-License-Identifier: Apache-2.0
// From the surfaces of the studio file to what the desk plugs in.
#pragma once

#include <vector>

#include "controller/daemon/output/desk.h"

namespace chiaro::daemon {

std::vector<SurfacePlan> surface_plans(const studio::Studio& studio);

}  // namespace chiaro::daemon
