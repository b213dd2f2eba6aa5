// SPDX-License-Identifier: Apache-2.0
// What in a photograph is its subject and what is behind it: OpenCV's GrabCut, started from the
// face where there is one, else from how far each pixel is from the colours along the border.
#pragma once

#include <optional>

#include "controller/core/picture.h"
#include "controller/design/faces.h"

namespace chiaro::design {

/// 1 = subject, 0 = background, over the picture's central square. Empty where nothing stands out.
core::Plane foreground_of(const core::Picture& central_square, const std::optional<FaceBox>& face);

/// A face's box guessed from an outline: the upper part of what stands out. Nothing where the
/// outline fills the picture or is empty.
std::optional<FaceBox> head_in_outline(const core::Plane& foreground);

}  // namespace chiaro::design
