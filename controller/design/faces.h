// SPDX-License-Identifier: Apache-2.0
// Where the faces are in a picture: OpenCV's cascades of the package opencv-data, frontal and
// profile, on the picture as it is and evened out, since half a face may be dark.
#pragma once

#include <vector>

#include "controller/core/picture.h"

namespace chiaro::design {

/// A face as the frontal cascade boxes it, from the middle of the forehead to the chin. Units: the
/// picture's central square has side 1 and its upper left corner at 0, 0.
struct FaceBox {
  double x = 0.5, y = 0.5, side = 0.3;  ///< centre and width
};

struct Faces {
  std::vector<FaceBox> boxes;  ///< most certain first, no two of one face
  std::vector<double> certainty;
  bool profile = false;      ///< seen from the side: boxed less exactly
  bool no_cascades = false;  ///< opencv-data is not installed: nothing was looked for
};

/// Thread-safe, deterministic. `grey` is display-linear luminance of any size.
Faces faces_in(const core::Plane& grey);

/// What people call it when faces_in() cannot look.
inline constexpr const char* kNoCascades = "faces cannot be found: install the package opencv-data";

}  // namespace chiaro::design
