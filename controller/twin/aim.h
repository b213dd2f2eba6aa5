// SPDX-License-Identifier: Apache-2.0
// Where a moving head must turn to point somewhere: the inverse of `pose` for its pan and tilt.
#pragma once

#include <optional>

#include "controller/core/geometry.h"
#include "controller/core/units.h"
#include "controller/studio/studio.h"

namespace chiaro::twin {

/// Angles as the DOFs pan and tilt count them: radians from the mount's neutral aim.
struct PanTilt {
  double pan = 0, tilt = 0;
};

/// The angles within `pan` and `tilt` at which the head points at `target`, nearest to `from` (the
/// axis that turns further counts): a yoke has two ways to point anywhere, and a head that turns
/// 540 degrees has each of them twice. Straight along the pan axis any pan will do, and `from`'s is
/// kept. Nothing when the head cannot turn there, or hangs at the target.
std::optional<PanTilt> aimed_at(const studio::PanTiltMount& mount, core::Range pan,
                                core::Range tilt, core::Vec3 target, PanTilt from);

}  // namespace chiaro::twin
