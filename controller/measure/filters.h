// SPDX-License-Identifier: Apache-2.0
// The two neighbourhood operators of the thesis in their right forms, for whole planes. The hot
// path fuses its own Sobel; these are the plain ones that it is tested against.
#pragma once

#include "controller/core/picture.h"

namespace chiaro::measure {

/// |G| / 8 in values per pixel [I-14, I-16]; the border repeats outwards.
core::Plane sobel_magnitude(const core::Plane& values);
/// (8 I - sum of the eight neighbours) / 8 [I-15]: 0 on every plane; the border repeats outwards.
core::Plane laplacian(const core::Plane& values);

}  // namespace chiaro::measure
