// SPDX-License-Identifier: Apache-2.0
// Readers of what a control does and what it shows; a map and a studio file write them alike.
#pragma once

#include <vector>

#include "controller/studio/reading/report.h"
#include "controller/studio/surface_map.h"

namespace chiaro::studio {

/// do: blackout, {master: grand}, {level: key, step: 1 %}, {warmer: 0.25 stops}, or a list of such.
std::vector<Deed> read_deeds(const reading::Tree* tree, SurfaceControl::Kind kind,
                             reading::Report& report);
/// shows: tally, {master: grand}, {level: key} …; when absent, what the first deed changes.
Shown read_shown(const reading::Tree* tree, const std::vector<Deed>& deeds,
                 reading::Report& report);

}  // namespace chiaro::studio
