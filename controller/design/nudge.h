// SPDX-License-Identifier: Apache-2.0
// A look changed a little, the way people ask for it on set: brighter, softer, warmer, more
// contrast, in quarter stops. A nudge changes what the picture should be; levels and colours are
// solved for it anew, with what is plugged in and free to change.
#pragma once

#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/design/design.h"

namespace chiaro::design {

/// Signed steps; 0 = leave it.
struct Nudge {
  double brightness = 0;  ///< quarter stops of light, the whole picture
  double warmth = 0;      ///< steps of kNudgeMired: an eighth of an orange or blue correction gel
  double contrast = 0;    ///< quarter stops between the subject's light and shadow
  double softness = 0;    ///< quarter stops of how wide the key light looks from the face
  friend bool operator==(const Nudge&, const Nudge&) = default;
};
inline constexpr double kNudgeMired = 20;
/// No single nudge goes further than this, in steps.
inline constexpr double kMostSteps = 16;

/// "a little warmer, more dramatic": see vocabulary.h for the words. Every word that is not
/// understood is a problem with the nearest one that would be.
core::Result<Nudge> nudge_from_words(const std::string& text);
/// "½ stop brighter, a little warmer": what a nudge asks for, for people.
std::string nudge_in_words(const Nudge& nudge);

struct NudgeOptions {
  std::vector<std::string> locked;    ///< fixtures that keep level and colour
  core::Size working_size{64, 64};    ///< levels are solved on a picture of this size
  core::Size picture_size{256, 256};  ///< of Look::picture and placed_picture
};

struct Nudged {
  /// Levels and colours changed in `wanted` and in `placed`, no stand moved; its verdict says how
  /// much of the step was done, its instructions begin with what a person must do for the rest.
  Look look;
  Nudge done;                        ///< as measured on the picture of the placed lamps
  std::vector<std::string> by_hand;  ///< what the lamps cannot do alone; also in look.instructions
};

/// Milliseconds to tens of them. Thread-safe. Problems: a look of another studio, an unknown lock,
/// every lamp locked, a step that is no number or too far.
core::Result<Nudged> nudged(const studio::Studio& studio, const LayersSource& twin,
                            const Look& look, const Nudge& nudge, const NudgeOptions& options = {});

}  // namespace chiaro::design
