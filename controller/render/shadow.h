// SPDX-License-Identifier: Apache-2.0
// Shadow rays: which part of a light each sample of a view sees.
#pragma once

#include <cstddef>
#include <span>

#include "controller/render/view.h"

namespace chiaro::render {

/// Visible fraction 0..1 for samples first .. first + out.size() of the view, weighted by how much
/// each part of the face gives to the surface. `across` strata per side of an area light's face
/// (1 = its centre); they are the same for every sample: no noise, and the same answer always.
/// Up to 4 x 4 strata are traced first; only where they disagree are all of them.
/// Where the light stands below the surface's horizon, the answer is for a light just above it in
/// the same direction: so blends of several places fade smoothly towards the terminator.
/// Counts its rays.
void trace_fraction(const View& view, const twin::Light& light, int across, std::size_t first,
                    std::span<float> out);

}  // namespace chiaro::render
