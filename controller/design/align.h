// SPDX-License-Identifier: Apache-2.0
// --align auto: a photograph's subject seldom stands in its frame where ours does. The exemplar is
// laid on our subject by the face, else by what stands out from the background, and mirrored where
// its sitter is turned the other way.
#pragma once

#include <string>

#include "controller/core/gbuffer.h"
#include "controller/design/design.h"
#include "controller/design/faces.h"

namespace chiaro::design {

/// The part of an exemplar that is looked at: a square about a centre, in units of the picture's
/// central square (side 1, centre 0.5, 0.5). What lies beyond the picture repeats its border.
struct Window {
  double x = 0.5, y = 0.5, side = 1;
  bool mirrored = false;  ///< left and right of the window are exchanged
};
core::Picture seen_through(const core::Picture& exemplar, const Window& window, core::Size size);
core::Plane seen_through(const core::Plane& plane, const Window& window, core::Size size);

/// The window that lays the face (or head) `theirs` of an exemplar on `ours`.
Window window_for(const FaceBox& ours, const FaceBox& theirs);

/// Where our own subject's face is in the central square of the main camera.
struct OurFace {
  FaceBox box;
  bool of_the_bust = false;  ///< the sitter that the shipped moods were drawn with
  double turn = 0;           ///< radians, which way the face looks: positive to the camera's right
};
/// From the file for the shipped sitter, whose landmarks are known; from the view for others: the
/// cascade's box on the subject lit from the camera, else the upper part of its outline. Nothing
/// where the view shows no subject.
std::optional<OurFace> our_face(const studio::Studio& studio, const core::GeometryPlanes& planes);
/// That of the sitter in the shipped moods, as their camera saw it.
FaceBox face_of_drawn_moods();

/// How an exemplar lies on our subject.
struct Alignment {
  enum class By { own_framing, face, outline, nothing };
  By by = By::nothing;
  Window window;
  FaceBox theirs;          ///< the exemplar's, in its central square
  core::Plane foreground;  ///< 1 where the exemplar's central square shows its subject
  bool coloured = true;
  std::vector<std::string> words;  ///< for people: what was found and what could not be
};

/// `turned`: our own face's turn; a mirrored exemplar is wanted where its face is turned the other
/// way by more than 15 degrees.
Alignment aligned(const ExampleGoal& goal, const OurFace& ours);

}  // namespace chiaro::design
