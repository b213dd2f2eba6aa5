// SPDX-License-Identifier: Apache-2.0
// What a photographer looks at before pressing the button and a picture measure does not: glare in
// glasses, catch-lights in the eyes, burnt skin, a background that outshines the face, the sitter's
// shadow on the wall. Found for a designed look, said with a remedy.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/design/layers.h"
#include "controller/twin/scene.h"

namespace chiaro::design {

/// Where the sitter's eyes are and look, studio frame. `right` and `left` are the sitter's own.
struct Eyes {
  core::Vec3 right, left;
  core::Vec3 gaze{0, -1, 0};  ///< unit, level
};
/// Guessed from where the first subject's head is and which way it faces: the eyes of a usual head
/// are 63 mm apart and 75 mm before its middle. Precondition: a subject and a camera.
Eyes eyes_of(const studio::Studio& studio);

/// One glass of a pair of spectacles: a flat ellipse.
struct Lens {
  core::Vec3 centre, normal;  ///< unit, away from the eye
  double half_width = 0.026, half_height = 0.020;
};
/// 12 mm before the eyes, leaning forward at the top by 8 degrees as frames do.
std::array<Lens, 2> glasses_on(const Eyes& eyes);

/// True where the camera sees the lamp in the glass: the lamp, mirrored in the lens's plane, stands
/// behind the ellipse as seen from the camera. `lamp_radius`: half of its larger side.
bool shows_in(const Lens& lens, core::Vec3 lamp, double lamp_radius, core::Vec3 camera);

/// True where the lamp makes a highlight on the iris: the cornea is a small ball, so the highlight
/// stands half-way between the directions to lamp and camera, and shows up to 35 degrees from the
/// gaze.
bool catches(core::Vec3 eye, core::Vec3 gaze, core::Vec3 lamp, core::Vec3 camera);

struct Comfort {
  std::vector<std::size_t> glare;            ///< lit fixtures that would show in glasses
  bool right_eye = false, left_eye = false;  ///< have a catch-light
  double burnt_skin = 0;                     ///< share of the subject's pixels at or above white
  double burnt_background = 0;               ///< share of the background's
  double background_over_face = 0;           ///< stops, mean against mean; negative: darker
  struct Shadow {
    std::size_t fixture = 0;
    double share = 0;  ///< of the background that shows
    double stops = 0;  ///< how much darker it is there
  };
  std::vector<Shadow> shadows;  ///< on the background, of lamps that throw one that is seen
};
/// `picture`: the look's prediction at layers.size().
Comfort comfort_of(const studio::Studio& studio, const Layers& layers, const studio::Rig& rig,
                   const core::Picture& picture);

/// As warnings with their remedies; glare only for sitters who wear glasses.
std::vector<std::string> comfort_in_words(const studio::Studio& studio, const studio::Rig& rig,
                                          const Comfort& comfort, bool glasses);

/// How much of the lit lamps' light stands where it shows in glasses, 0..1: cheap enough for every
/// trial. Levels count as in `rig`.
double glare_share(const studio::Studio& studio, const studio::Rig& rig);

}  // namespace chiaro::design
