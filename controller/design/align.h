// SPDX-License-Identifier: Apache-2.0
// --align auto: a photograph's subject seldom stands in its frame where ours does. The exemplar is
// shifted and scaled to lie on our subject as well as the goal itself can tell.
#pragma once

#include "controller/design/design.h"

namespace chiaro::design {

/// The part of an exemplar that is looked at: a square about a centre, in units of the picture's
/// central square (side 1, centre 0.5, 0.5). What lies beyond the picture repeats its border.
struct Window {
  double x = 0.5, y = 0.5, side = 1;
};
core::Picture seen_through(const core::Picture& exemplar, const Window& window, core::Size size);

/// The window, between 0.7 and 1.4 in side and at most a quarter off centre, whose luminance comes
/// nearest to `ours` by the Haar distance in L*. The whole square unless another is 5 % better.
Window best_window(const core::Picture& exemplar, const core::Plane& ours, std::uint64_t seed);

}  // namespace chiaro::design
