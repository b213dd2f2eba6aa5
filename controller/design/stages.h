// SPDX-License-Identifier: Apache-2.0
// The stages of one design, each a function from what is known to a rig; design() calls them in
// order.
#pragma once

#include "controller/design/asked.h"
#include "controller/design/search.h"

namespace chiaro::design {

/// A goal at one picture size, with the layers to meet it.
struct Prepared {
  const Layers& layers;
  Target target;
  measure::PixelMap map;
};
/// Small to search on, middle to polish on, full to end on.
struct Sizes {
  Prepared small, middle, full;
};
/// For ideal goals the scene is probed, on the small picture, for what it can show.
/// `wishes` may be null.
Sizes prepare(const studio::Studio& studio, const Goal& goal, const Variables& variables,
              const Layers& small, const Layers& middle, const Layers& full,
              std::shared_ptr<const Wishes> wishes = nullptr);

/// The lamps that the outer search moves: all of them, in ideal those of stage one.
Variables searched(const studio::Studio& studio, const Variables& all, const Goal& goal);

/// A rig whose placements are settled: levels, back and background lights, colours, flash steps.
/// `may_move_back`: ideal's stage two may choose the back light's place.
studio::Rig completed(const studio::Studio& studio, const Sizes& sizes, const Variables& all,
                      const studio::Rig& placements, bool may_move_back, Watch& watch);

/// The variables and the setting that a completed rig is judged with.
Variables judged(const studio::Studio& studio, const Target& target, const Variables& all,
                 const studio::Rig& rig);

}  // namespace chiaro::design
