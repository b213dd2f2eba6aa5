// SPDX-License-Identifier: Apache-2.0
// What each term of the perceptual objective offers, and the table of them all.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

struct Term {
  std::string_view name, summary;
  /// Cost of being like an example, about 0..1, 0 = met; nothing when the target is absent.
  std::optional<double> (*example)(const Components& now, const Targets& wanted,
                                   const TermWeights& options);
  /// Cost under the ideal goal [I-13], about 0..1, 0 = as well as can be.
  double (*ideal)(const Components& now, const IdealTargets& wanted, const TermWeights& options);
  double TermWeights::*weight;
};

/// In the order of terms.def, which is the order of the thesis's weights.
std::span<const Term> all();

/// |now - wanted| / max(now, wanted): 0..1, for components without an upper end.
double relative_difference(double now, double wanted);
/// |now - wanted| over the most it can be in 0..most.
double spanned_difference(double now, double wanted, double most);

}  // namespace chiaro::measure::terms
