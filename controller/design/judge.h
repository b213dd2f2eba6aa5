// SPDX-License-Identifier: Apache-2.0
// How near a rig comes to its goal, what holds it back and the cheapest thing that would help.
#pragma once

#include "controller/design/trial.h"

namespace chiaro::design {

/// Residual of a scored rig, 0 = met. Wavelet: the distance as a share of the exemplar's distance
/// from a studio with every lamp dark. Perceptual: the mean relative deviation of the components
/// that have a target, as the thesis's tables 4.1-4.3 are read. Ideal: how much better the cost
/// would be were no lamp limited, relative to the cost.
double residual_of(const Setting& setting, Workspace& workspace, const studio::Rig& rig);

/// Precondition: `rig`'s levels are solved for its placements.
Judgement judge(const Setting& setting, Workspace& workspace, const studio::Rig& rig);

/// The components of the rig's picture beside their targets.
std::vector<Component> component_list(const Setting& setting, Workspace& workspace,
                                      const studio::Rig& rig);

}  // namespace chiaro::design
