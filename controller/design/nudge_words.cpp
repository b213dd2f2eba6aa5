// SPDX-License-Identifier: Apache-2.0
// "a little warmer, more dramatic" in, a nudge out, and back.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "controller/design/nudge.h"
#include "controller/design/vocabulary.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

// In steps: a quarter stop is the least that people call a change.
constexpr double kLittle = 1, kPlain = 2, kMuch = 4;

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The text cut at commas, semicolons, "and" and "but" into lists of words.
std::vector<std::vector<std::string>> wishes_of(const std::string& text) {
  std::string spaced;
  for (const char c : lower_case(text))
    spaced += c == ',' || c == ';' || c == '.' || c == '+' ? " , " : std::string(1, c);
  std::vector<std::vector<std::string>> wishes(1);
  std::istringstream in(spaced);
  for (std::string word; in >> word;) {
    if (word == "," || word == "and" || word == "but")
      wishes.emplace_back();
    else
      wishes.back().push_back(word);
  }
  wishes.erase(
      std::remove_if(wishes.begin(), wishes.end(), [](const auto& w) { return w.empty(); }),
      wishes.end());
  return wishes;
}

void add(Nudge& sum, double factor, const Nudge& what) {
  sum.brightness += factor * what.brightness;
  sum.warmth += factor * what.warmth;
  sum.contrast += factor * what.contrast;
  sum.softness += factor * what.softness;
}

bool among(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* each) { return word == each; });
}

core::Problem not_understood(const std::string& word) {
  const std::string near = core::nearest_name(word, known_words());
  return {{},
          "\"" + word + "\" is not among the words of light",
          near.empty() ? "say it as in: a little warmer, more dramatic, less contrast"
                       : "did you mean \"" + near + "\"?"};
}

/// One wish: how much, which way, what.
void read_wish(const std::vector<std::string>& words, Nudge& sum, core::Problems& problems) {
  double amount = kPlain, sign = 1;
  const Word* what = nullptr;
  for (const std::string& word : words) {
    if (among(word, {"little", "bit", "slightly", "touch"}))
      amount = kLittle;
    else if (among(word, {"much", "lot", "far", "very"}))
      amount = kMuch;
    else if (among(word, {"less", "not"}))
      sign = -sign;
    else if (among(word, {"a", "of", "more", "the", "it", "so", "too", "make", "please", "light"}))
      continue;
    else if (const Word* found = word_called(word)) {
      if (what != nullptr) add(sum, sign * amount, what->nudge);
      what = found;
    } else
      problems.push_back(not_understood(word));
  }
  if (what != nullptr)
    add(sum, sign * amount, what->nudge);
  else if (problems.empty())
    problems.push_back({{},
                        "\"" + words.back() + "\" does not say what to change",
                        "say it as in: a little warmer, more dramatic, less contrast"});
}

void say(std::string& text, double steps, const std::string& up, const std::string& down,
         const std::string& amount) {
  if (std::abs(steps) < 1e-9) return;
  text += (text.empty() ? "" : ", ") + amount + " " + (steps > 0 ? up : down);
}

}  // namespace

core::Result<Nudge> nudge_from_words(const std::string& text) {
  Nudge sum;
  core::Problems problems;
  const auto wishes = wishes_of(text);
  if (wishes.empty())
    return core::Problem{{}, "no wish was said", "say it as in: a little warmer, more dramatic"};
  for (const auto& wish : wishes) read_wish(wish, sum, problems);
  if (!problems.empty()) return problems;
  for (double* steps : {&sum.brightness, &sum.warmth, &sum.contrast, &sum.softness})
    *steps = std::clamp(*steps, -kMostSteps, kMostSteps);
  return sum;
}

std::string nudge_in_words(const Nudge& nudge) {
  const auto stops = [](double steps) {
    const double quarters = std::round(4 * std::abs(steps)) / 4;
    return number(quarters / 4, 2) + (quarters > 4 ? " stops" : " stop");
  };
  std::string text;
  say(text, nudge.brightness, "brighter", "darker", stops(nudge.brightness));
  say(text, nudge.warmth, "warmer", "cooler",
      number(kNudgeMired * std::abs(nudge.warmth), 0) + " mired");
  say(text, nudge.contrast, "more contrast", "less contrast", stops(nudge.contrast));
  say(text, nudge.softness, "softer", "harder", stops(nudge.softness));
  return text.empty() ? "as it is" : text;
}

}  // namespace chiaro::design
