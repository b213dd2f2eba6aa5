// SPDX-License-Identifier: Apache-2.0
// Ideal lighting's own parts: the targets that depend on the scene, and the stages after the first.
// Stage one lights the shape with key, fill and what else faces it, back and background lamps dark.
// Stage two sets the back light on the subject's outer edges alone (thesis 3.2.2). Stage three
// lights the background, on the same edges, never brighter than the subject.
#pragma once

#include "controller/design/trial.h"

namespace chiaro::design {

enum class IdealStage { shape, back, background };
IdealStage stage_of(studio::Role role);

/// The variables of one stage: lamps of other stages are held as `base` has them; in stage one they
/// are dark.
Variables variables_of(const studio::Studio& studio, const Variables& all, IdealStage stage,
                       const studio::Rig& base);

/// T* and C* of [I-13]: the steepest shading gradient and the strongest contrast that the key alone
/// can show at the wanted mean, over a lattice of its region.
measure::IdealTargets attainable_targets(const Setting& setting);

/// Stages two and three. `setting.variables` are all lamps'; `rig` comes from stage one.
studio::Rig with_back_lights(const Setting& setting, studio::Rig rig, bool may_move);
studio::Rig with_background_lights(const Setting& setting, studio::Rig rig);

/// The map with the subject's outer silhouette as its only edges.
measure::PixelMap silhouette_of(const measure::PixelMap& map);
/// How well those edges show, 0..1: the mean of their shares that show at all, clearly, and as a
/// bright rim. 0 when there are none.
double silhouette_share(const core::Plane& luminance, const measure::PixelMap& silhouette);

}  // namespace chiaro::design
