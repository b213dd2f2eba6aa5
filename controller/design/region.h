// SPDX-License-Identifier: Apache-2.0
// A part of the picture that a person points at: drawn on it, or named. What a goal by hand is
// about.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "controller/core/gbuffer.h"
#include "controller/core/picture.h"
#include "controller/studio/studio.h"

namespace chiaro::design {

/// Drawn regions are in shares of the main camera's whole frame, 0, 0 the upper left corner, 1, 1
/// the lower right.
struct Region {
  enum class Kind {
    everything,
    subject,
    background,
    face,
    object,
    rectangle,
    ellipse,
    polygon,
    mask
  };
  Kind kind = Kind::everything;
  double x = 0.5, y = 0.5;                    ///< centre of a rectangle or an ellipse
  double width = 1, height = 1;               ///< its whole width and height
  std::vector<std::array<double, 2>> points;  ///< a polygon's corners
  std::uint16_t object = 0;                   ///< id in the view: the subject's number, from 1
  core::Plane mask;                           ///< white where it is, over the whole frame
  std::string words = "the picture";          ///< for people: "the face", "a rectangle"
};

/// Where a point of the frame lies in the square that designs look at, 0..1; outside of that where
/// the square does not show it.
std::array<double, 2> in_square(const studio::Camera& camera, double x, double y);

/// How much of each pixel of the square view belongs to the region, 0..1. `planes`: of that view,
/// at `size`; null where no geometry is known: the subject is then everything.
core::Plane mask_of(const Region& region, const studio::Studio& studio,
                    const core::GeometryPlanes* planes, core::Size size);

}  // namespace chiaro::design
