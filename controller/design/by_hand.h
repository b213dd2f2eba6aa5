// SPDX-License-Identifier: Apache-2.0
// A goal by hand carried out: what it should be like is designed first, where that is asked, then
// the paint is laid on and solved for, wishes and bounds beside it all the way.
#pragma once

#include "controller/design/goal_json.h"

namespace chiaro::design {

/// Gives every camera of the wishes its view. Thread-safe.
core::Problems with_twins(Wishes& wishes, const studio::Studio& studio,
                          const GeometricOptions& options);

/// `like`: the goal that `hand` names, when it names a mood, an exemplar or the ideal. `rig`: whose
/// picture is painted on otherwise. `options.wishes` are the hand's.
core::Result<Look> design_by_hand(const studio::Studio& studio, const LayersSource& twin,
                                  GoalByHand hand, const std::optional<Goal>& like,
                                  const studio::Rig& rig, Options options);

}  // namespace chiaro::design
