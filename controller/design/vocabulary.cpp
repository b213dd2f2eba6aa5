// SPDX-License-Identifier: Apache-2.0
#include "controller/design/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

constexpr core::Size kLookedAt{128, 128};
constexpr double kDark = 25;  // L*
constexpr double kTenth = 0.1, kSteep = 0.98;

double percentile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

core::Picture square(const core::Picture& picture) {
  const core::Size size = picture.size();
  const int side = std::min(size.width, size.height);
  const int x0 = (size.width - side) / 2, y0 = (size.height - side) / 2;
  core::Picture out(core::Size{side, side});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) out.set(x, y, picture.at(x + x0, y + y0));
  return core::resized(out, kLookedAt);
}

std::vector<float> steps_of(const core::Plane& lightness) {
  std::vector<float> steps;
  for (int y = 0; y + 1 < lightness.size.height; ++y)
    for (int x = 0; x + 1 < lightness.size.width; ++x)
      steps.push_back(std::hypot(lightness.at(x + 1, y) - lightness.at(x, y),
                                 lightness.at(x, y + 1) - lightness.at(x, y)));
  return steps;
}

}  // namespace

Qualities qualities_of(const core::Picture& picture) {
  if (picture.size().pixels() == 0) return {};
  const core::Picture seen = square(picture);
  core::Plane lightness = core::luminance(seen);
  double red = 0, blue = 0, dark = 0;
  for (std::size_t i = 0; i < lightness.values.size(); ++i) {
    lightness.values[i] =
        static_cast<float>(core::lightness(std::min<double>(lightness.values[i], 1)));
    dark += lightness.values[i] < kDark;
    red += std::clamp<double>(seen.red.values[i], 0, 1);
    blue += std::clamp<double>(seen.blue.values[i], 0, 1);
  }
  Qualities out;
  std::vector<float> values = lightness.values;
  const auto n = static_cast<double>(values.size());
  out.lightness = std::accumulate(values.begin(), values.end(), 0.0) / n;
  out.darkness = dark / n;
  out.contrast = percentile(values, 1 - kTenth) - percentile(values, kTenth);
  out.warmth = red > 0 || blue > 0 ? std::log((red + 1e-3) / (blue + 1e-3)) : 0;
  std::vector<float> steps = steps_of(lightness);
  out.hardness = percentile(steps, kSteep);
  return out;
}

const std::vector<Word>& vocabulary() {
  using Q = Qualities;
  // brightness, warmth, contrast, softness of one step more of it.
  static const std::vector<Word> words{
#include "controller/design/vocabulary.def"
  };
  return words;
}

const Word* word_called(const std::string& name) {
  for (const Word& word : vocabulary())
    if (word.name == name || word.more == name) return &word;
  return nullptr;
}

std::vector<std::string> known_words() {
  std::vector<std::string> known;
  for (const Word& word : vocabulary()) {
    known.push_back(word.name);
    if (!word.more.empty()) known.push_back(word.more);
  }
  return known;
}

double fit(const Word& word, const Qualities& qualities) {
  double sum = 0;
  for (const Claim& claim : word.claims)
    sum += std::clamp((qualities.*claim.quality - claim.from) / (claim.to - claim.from), 0.0, 1.0);
  return word.claims.empty() ? 0 : sum / static_cast<double>(word.claims.size());
}

}  // namespace chiaro::design
