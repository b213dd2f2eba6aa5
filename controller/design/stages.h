// SPDX-License-Identifier: Apache-2.0
// The stages of one design, each a function from what is known to a rig; design() calls them in
// order.
#pragma once

#include "controller/design/search.h"

namespace chiaro::design {

/// A goal at one picture size, with the layers to meet it.
struct Prepared {
  const Layers& layers;
  Target target;
  measure::PixelMap map;
};
/// For ideal goals the scene is probed for what it can show.
Prepared prepare(const studio::Studio& studio, const Layers& layers, const Goal& goal,
                 const Variables& variables);

/// The lamps that the outer search moves: all of them, in ideal those of stage one.
Variables searched(const studio::Studio& studio, const Variables& all, const Goal& goal);

/// A rig whose placements are settled: levels, back and background lights, colours, flash steps.
/// `may_move_back`: ideal's stage two may choose the back light's place.
studio::Rig completed(const studio::Studio& studio, const Prepared& full, const Variables& all,
                      const studio::Rig& placements, bool may_move_back, Watch& watch);

/// The variables and the setting that a completed rig is judged with.
Variables judged(const studio::Studio& studio, const Target& target, const Variables& all,
                 const studio::Rig& rig);

}  // namespace chiaro::design
