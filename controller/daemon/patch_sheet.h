// SPDX-License-Identifier: Apache-2.0
// The patch sheet: the page a gaffer pins up beside the desk. What is where on which address.
#pragma once

#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/core/result.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// One line per lamp; `places[i]` is where fixture i is now, seen from the subject's aim.
struct PatchSheet {
  const studio::Studio& studio;
  std::vector<core::Spherical> places;
};
PatchSheet patch_sheet(const studio::Studio& studio, const core::AimFrame& aim);

std::string to_text(const PatchSheet& sheet);
/// One JSON object: studio, fixtures, outputs, and `warnings` as its problems.
std::string to_json(const PatchSheet& sheet, const core::Problems& warnings);

}  // namespace chiaro::daemon
