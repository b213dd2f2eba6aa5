// SPDX-License-Identifier: Apache-2.0
// The lamps' side of a nudge: the picture that is wanted, and the levels and colours that come
// nearest to it for lamps that stand still.
#pragma once

#include <vector>

#include "controller/design/layers.h"
#include "controller/design/nudge.h"

namespace chiaro::design {

/// What a nudge works with; all borrowed.
struct NudgeSetting {
  const studio::Studio& studio;
  const Layers& layers;
  std::vector<std::size_t> free;  ///< fixtures that may change, ascending
};

/// A lamp that could not go as far as the nudge wanted it to.
struct Limit {
  std::size_t fixture = 0;
  double missing = 0;  ///< stops of light, or mired; the sign says which way
};
struct NudgedRig {
  studio::Rig rig;
  Nudge done;  ///< brightness, warmth and contrast as measured on the subject
  std::vector<Limit> dim, off_colour;  ///< the worst first
};
/// Softness is nothing that levels can change and stays 0.
NudgedRig nudged_rig(const NudgeSetting& setting, const studio::Rig& rig, const Nudge& nudge);

/// "fit the softbox to the key …": what a person can do to make the key light look wider
/// (steps > 0) or smaller from the face; what to say where nothing can be done.
std::string softness_by_hand(const studio::Studio& studio, const studio::Rig& rig, double steps);

}  // namespace chiaro::design
