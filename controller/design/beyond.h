// SPDX-License-Identifier: Apache-2.0
// Goals beyond what the lamps can do: a black frame, a colour that no fitted lamp makes, a subject
// that the camera does not see, lamps that are all locked. The look is still the best there is;
// these say what is missing from it.
#pragma once

#include <string>

#include "controller/design/layers.h"
#include "controller/design/target.h"
#include "controller/design/variables.h"

namespace chiaro::design {

/// Empty unless the reference picture shows next to no light anywhere.
std::string black_in_words(const Target& target);

/// How far the colour of `picture` (display-linear) stays from a strongly coloured reference's, as
/// a share of that colour's distance from grey: 0 = the same, 1 = none of it. 0 for references
/// whose colour is within what white lamps and skin make.
double colour_missing(const Target& target, const core::Picture& picture);

/// Lowers the verdict, and gives the remedy, where colour is missing; else leaves both alone.
void judge_colour(const Target& target, const core::Picture& picture, Judgement& judgement);

/// Empty unless the view shows too little of the subject to light it by.
std::string unseen_in_words(const studio::Studio& studio, const Layers& layers);

/// The remedy where nothing was left to change; else leaves it alone.
void judge_locked(const Variables& variables, Judgement& judgement);

}  // namespace chiaro::design
