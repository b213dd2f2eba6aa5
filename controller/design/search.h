// SPDX-License-Identifier: Apache-2.0
// The outer search over positions: coarse on a small picture, then the best basins polished on the
// full one. Levels are solved inside each trial.
#pragma once

#include "controller/design/starts.h"

namespace chiaro::design {

struct Found {
  optimise::Point point;
  double cost = std::numeric_limits<double>::infinity();  ///< +infinity: nothing may stand anywhere
};

/// A sensible number of trials for that many placement variables: over the shipped moods twice and
/// four times as many change the cost by less than 1 %.
std::uint64_t default_trials(std::size_t variables);

/// On the coarse setting; several basins, best first, never empty when any place is allowed.
std::vector<Found> search(const Setting& coarse, const Options& options, Watch& watch);

/// Starts from each of the first few basins, on the full picture; gives the best.
Found polish(const Setting& full, const std::vector<Found>& basins, const Options& options,
             Watch& watch);

/// The yardstick: levels are variables of the search too, every trial renders all anew. Gives the
/// best rig, levels included.
struct ReferenceFound {
  studio::Rig rig;
  double cost = std::numeric_limits<double>::infinity();
};
ReferenceFound reference_search(const Setting& full, const Options& options, Watch& watch);

}  // namespace chiaro::design
