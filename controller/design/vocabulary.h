// SPDX-License-Identifier: Apache-2.0
// A small vocabulary of light: each word is tied to things that can be measured in a picture, and
// to the nudge that goes its way. No model, no weights to download: the table is in the source and
// can be read.
#pragma once

#include <string>
#include <vector>

#include "controller/core/picture.h"
#include "controller/design/moods.h"
#include "controller/design/nudge.h"

namespace chiaro::design {

/// Measured on the central square of a display-linear picture.
struct Qualities {
  double lightness = 0;  ///< mean L*, 0..100
  double contrast = 0;   ///< L* between the darkest and the lightest tenth of the picture
  double darkness = 0;   ///< share of the picture below L* 25, 0..1
  double warmth = 0;     ///< natural logarithm of red to blue in the picture's light
  double hardness = 0;   ///< steepest edges: L* per 1/128 of the height, 98th percentile
};
Qualities qualities_of(const core::Picture& picture);

/// One thing a word claims: 0 where the quality is at `from`, 1 from `to` on, a line between;
/// `from` > `to` claims little of it.
struct Claim {
  double Qualities::*quality;
  double from = 0, to = 1;
};
struct Word {
  std::string name;      ///< "dark"
  std::string more;      ///< "darker"; empty: said as "more dark"
  std::string opposite;  ///< "bright"
  std::string meaning;   ///< for people, in the terms that are measured
  std::vector<Claim> claims;
  Nudge nudge;  ///< what one step of "more of it" does
};
const std::vector<Word>& vocabulary();
/// By name or comparative; null when there is none.
const Word* word_called(const std::string& name);
/// Every name and comparative, for suggestions.
std::vector<std::string> known_words();

/// How well the word fits, 0..1: the mean of its claims.
double fit(const Word& word, const Qualities& qualities);

struct MoodMatch {
  std::size_t mood = 0;              ///< index into the moods asked about
  double score = 0;                  ///< 0..1
  std::vector<std::string> because;  ///< "dark: mean L* 22", "tagged warm"
};
struct MoodSearch {
  std::vector<MoodMatch> matches;    ///< best first, every mood in it; equal scores by name
  std::vector<std::string> unknown;  ///< words that say nothing about any mood, with a suggestion
};
/// `qualities` beside `moods`. No words: every mood in its order with score 0.
MoodSearch search_moods(const std::vector<Mood>& moods, const std::vector<Qualities>& qualities,
                        const std::string& words);
/// Of each mood's picture; a picture that cannot be read gives the default and a problem.
std::vector<Qualities> qualities_of(const std::vector<Mood>& moods, core::Problems& problems);

}  // namespace chiaro::design
