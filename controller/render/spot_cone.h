// SPDX-License-Identifier: Apache-2.0
// A spot for one object of several: the thesis's 3D interactive lighting [I-36]. The cone must hold
// its object and should spare the neighbours; both are read off the view's object ids.
#pragma once

#include <cstdint>
#include <optional>

#include "controller/core/gbuffer.h"

namespace chiaro::render {

struct SpotCone {
  core::Vec3 direction;  ///< unit, from the lamp
  double angle = 0;      ///< radians, the full opening: Optic::field
  /// Share of the other subjects' visible samples that lie in the cone too, 0..1: 0 spares them.
  double spilled = 0;
};

/// The narrow cone from `at` over all that the camera sees of an object (1.. as in the buffer's
/// ids), within a few per cent of the narrowest. Nothing when the object is not seen, or all around
/// the lamp.
std::optional<SpotCone> cone_over(const core::GBuffer& view, std::uint16_t object, core::Vec3 at);

}  // namespace chiaro::render
