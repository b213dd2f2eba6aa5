// SPDX-License-Identifier: Apache-2.0
// Moods by words: what a mood is called and tagged counts whole, what its picture measures counts
// as well as it fits.
#include <algorithm>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/design/vocabulary.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

constexpr double kSaidInPassing = 0.7;  // in its sentence only
constexpr double kWorthNaming = 0.5;

/// Lower-case words without the small ones that carry no meaning.
std::vector<std::string> words_in(const std::string& text) {
  static const std::vector<std::string> small{"a",  "an",    "and", "the",  "of",   "in",
                                              "on", "light", "for", "with", "very", "mood"};
  std::string spaced;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
    if (c >= 'A' && c <= 'Z')
      spaced += static_cast<char>(c - 'A' + 'a');
    else
      spaced += letter ? c : ' ';
  }
  std::vector<std::string> words;
  std::istringstream in(spaced);
  for (std::string word; in >> word;)
    if (std::find(small.begin(), small.end(), word) == small.end()) words.push_back(word);
  return words;
}

bool holds(const std::string& text, const std::string& word) {
  const auto words = words_in(text);
  return std::find(words.begin(), words.end(), word) != words.end();
}

struct Found {
  double score = 0;
  std::string because;
};
/// The best reason why the word belongs to the mood.
Found found(const Mood& mood, const Qualities& qualities, const std::string& word) {
  if (holds(mood.name, word) || holds(mood.title, word)) return {1, "called " + word};
  for (const std::string& tag : mood.tags.words())
    if (holds(tag, word)) return {1, "tagged " + tag};
  for (const std::string& each : mood.words)
    if (holds(each, word)) return {1, "said to be " + each};
  Found best;
  if (const Word* measured = word_called(word)) {
    best.score = fit(*measured, qualities);
    best.because = "measures " + measured->name + " by " + number(100 * best.score, 0) + " %";
  }
  if (best.score < kSaidInPassing && holds(mood.sentence, word))
    best = {kSaidInPassing, "its sentence says " + word};
  return best;
}

bool anybody_has(const std::vector<Mood>& moods, const std::string& word) {
  return word_called(word) != nullptr ||
         std::any_of(moods.begin(), moods.end(),
                     [&](const Mood& m) { return found(m, {}, word).score > 0; });
}

std::string not_known(const std::vector<Mood>& moods, const std::string& word) {
  std::vector<std::string> known = known_words();
  for (const Mood& mood : moods) {
    known.push_back(mood.name);
    known.insert(known.end(), mood.words.begin(), mood.words.end());
  }
  for (const core::MoodTagKind& kind : core::mood_tag_kinds())
    known.insert(known.end(), kind.words.begin(), kind.words.end());
  const std::string near = core::nearest_name(word, known);
  return word + (near.empty() ? "" : " (did you mean " + near + "?)");
}

}  // namespace

MoodSearch search_moods(const std::vector<Mood>& moods, const std::vector<Qualities>& qualities,
                        const std::string& text) {
  MoodSearch search;
  std::vector<std::string> words;
  for (const std::string& word : words_in(text)) {
    if (anybody_has(moods, word))
      words.push_back(word);
    else
      search.unknown.push_back(not_known(moods, word));
  }
  for (std::size_t i = 0; i < moods.size(); ++i) {
    MoodMatch match;
    match.mood = i;
    for (const std::string& word : words) {
      const Found reason = found(moods[i], qualities[i], word);
      match.score += reason.score / static_cast<double>(words.size());
      if (reason.score >= kWorthNaming) match.because.push_back(reason.because);
    }
    search.matches.push_back(std::move(match));
  }
  std::stable_sort(search.matches.begin(), search.matches.end(),
                   [](const MoodMatch& a, const MoodMatch& b) { return a.score > b.score; });
  return search;
}

std::vector<Qualities> qualities_of(const std::vector<Mood>& moods, core::Problems& problems) {
  std::vector<Qualities> all;
  for (const Mood& mood : moods) {
    const auto picture = core::read_picture(mood.picture);
    if (!picture)
      problems.insert(problems.end(), picture.problems().begin(), picture.problems().end());
    all.push_back(picture ? qualities_of(core::linear(*picture)) : Qualities{});
  }
  return all;
}

}  // namespace chiaro::design
