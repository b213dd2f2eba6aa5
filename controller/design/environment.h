// SPDX-License-Identifier: Apache-2.0
// A place's light as a goal (Supan and Stuppacher 2006): a light probe or an environment map says
// how much light comes from where; the lamps are solved so that the subject looks as it would
// there.
#pragma once

#include <array>

#include "controller/design/design.h"

namespace chiaro::design {

/// Irradiance of an environment as a function of the normal: nine spherical harmonics per channel,
/// within a few per cent of the whole (Ramamoorthi and Hanrahan 2001).
class Irradiance {
 public:
  /// `probe`: equirectangular, linear light; its middle is what the subject sees when it looks at
  /// the camera, its upper edge the zenith, its right what lies to the camera's left.
  explicit Irradiance(const core::Picture& probe);
  /// On a surface with that normal, in a frame whose x is the camera's right, y away from the
  /// camera and z up; per channel, at least 0.
  core::Rgb at(core::Vec3 normal) const;

 private:
  std::array<core::Rgb, 9> coefficients_;
};

/// The subject lit by the probe as an example to be followed pixel by pixel; the background may be
/// what it will. `lightness`: mean L* of the subject, since a probe's scale is anybody's guess.
/// Problems: no geometry, a probe without light.
core::Result<ExampleGoal> environment_goal(const studio::Studio& studio, const LayersSource& twin,
                                           const core::Picture& probe, const std::string& name,
                                           double lightness, core::Size size);

}  // namespace chiaro::design
