// SPDX-License-Identifier: Apache-2.0
// Dimmer curves: how a drive on the wire becomes light, and the inverse that an encoder needs.
#pragma once

#include "controller/studio/profile.h"

namespace chiaro::patch {

/// Fraction of full linear light at `drive` (0..1, clamped):
/// linear d; square d^2; gamma d^g; s_curve 3d^2 - 2d^3; table linear between its entries.
/// Monotonic, 0 to 0 and 1 to 1 (a table: to its own ends). Real-time.
double light_of_drive(const studio::DimmerCurve& curve, double drive);
/// The least drive that gives this light. Real-time.
double drive_of_light(const studio::DimmerCurve& curve, double light);

}  // namespace chiaro::patch
