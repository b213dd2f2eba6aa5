// SPDX-License-Identifier: Apache-2.0
// What can only be judged when the whole studio has been read, one file each.
#pragma once

#include "controller/studio/reading/report.h"
#include "controller/studio/studio.h"

namespace chiaro::studio::checks {

/// Footprints beyond slot 512, addresses and registers that two fixtures share.
void check_addresses(const Studio& studio, reading::Report& report);
/// Universes in use without an output (error), outputs that carry nothing (warning).
void check_outputs(const Studio& studio, reading::Report& report);
/// Lamps and cameras above the ceiling.
void check_places(const Studio& studio, reading::Report& report);

}  // namespace chiaro::studio::checks
