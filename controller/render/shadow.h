// SPDX-License-Identifier: Apache-2.0
// Shadow rays: which part of a light each sample of a view sees.
#pragma once

#include <cstddef>
#include <span>

#include "controller/render/view.h"

namespace chiaro::render {

/// How an area light's face is sampled: `few` x `few` strata first, and where those disagree
/// `many` x `many`. The same strata for every sample: no noise, and the same answer always.
/// A small source takes one ray whatever is asked.
struct Strata {
  int few = 1, many = 1;
};
inline constexpr Strata kHard{1, 1};
inline constexpr Strata kCached{2, 4};
inline constexpr Strata kExact{4, 16};

/// Visible fraction 0..1 for samples first .. first + out.size() of the view, weighted by how much
/// each part of the face gives to the surface. Where the light stands below the surface's horizon,
/// the answer is for a light just above it in the same direction: so blends of several places fade
/// smoothly towards the terminator. Counts its rays. Thread-safe.
void trace_fraction(const View& view, const twin::Light& light, Strata strata, std::size_t first,
                    std::span<float> out);

}  // namespace chiaro::render
