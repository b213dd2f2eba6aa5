// SPDX-License-Identifier: Apache-2.0
// Hidden rigs and their pictures, for tests of the design engine on the analytic twin.
#pragma once

#include "controller/design/design.h"
#include "tests/support/analytic_layers.h"

namespace chiaro::support {

/// The picture of a rig, as a camera would deliver it: clipped at 1, 8 bits per channel.
core::Picture photographed(const studio::Studio& studio, const design::LayersSource& twin,
                           const studio::Rig& rig, core::Size size);
/// Sets a stand's place (degrees, metres) and level.
void stand(studio::Rig& rig, std::size_t fixture, double azimuth_deg, double elevation_deg,
           double distance, double level);
/// Angle between the directions of a lamp in two rigs, degrees.
double angle_off(const studio::Rig& a, const studio::Rig& b, std::size_t fixture);

design::ExampleGoal like(core::Picture picture,
                         design::Objective objective = design::Objective::wavelet);

}  // namespace chiaro::support
