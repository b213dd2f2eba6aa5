// SPDX-License-Identifier: Apache-2.0
// Colour by example: once lamps stand and shine, each emitter's CCT and tint or drives are solved
// towards the exemplar's chroma, under its own limits, its luminance kept.
#pragma once

#include "controller/design/trial.h"

namespace chiaro::design {

/// `rig` with colours for every lit lamp whose emitter has a choice; unchanged for goals that have
/// no opinion on colour (ideal, a grey exemplar). A lamp that adds nothing keeps its colour.
studio::Rig with_colours(const Setting& setting, const studio::Rig& rig);

/// The camera's balance, in kelvin, at which the picture's mean colour would match the exemplar's
/// best; nothing when the present one does within 150 K or the exemplar is grey.
std::optional<double> better_white_balance(const Target& target, const core::Picture& picture,
                                           core::Kelvin now);

/// Display-linear prediction of a whole rig, in colour.
core::Picture predicted(const studio::Studio& studio, const Layers& layers, const studio::Rig& rig,
                        Accuracy accuracy);

}  // namespace chiaro::design
