// SPDX-License-Identifier: Apache-2.0
#include "controller/design/vocabulary.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace chiaro::design {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

core::Picture plain(core::Rgb colour, core::Size size = {160, 120}) {
  core::Picture picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) picture.set(x, y, colour);
  return picture;
}

TEST(Qualities, OfAPlainPictureAreItsLightnessAndColour) {
  const Qualities grey = qualities_of(plain({0.1842, 0.1842, 0.1842}));
  EXPECT_NEAR(grey.lightness, 50, 0.1);
  EXPECT_NEAR(grey.contrast, 0, 0.01);
  EXPECT_EQ(grey.darkness, 0);
  EXPECT_NEAR(grey.warmth, 0, 0.01);
  EXPECT_NEAR(grey.hardness, 0, 0.01);
  EXPECT_NEAR(qualities_of(plain({0.4, 0.2, 0.1})).warmth, std::log(4), 0.02);
  EXPECT_EQ(qualities_of(plain({0, 0, 0})).darkness, 1);
  EXPECT_EQ(qualities_of(core::Picture()).lightness, 0);
}

TEST(Qualities, AHardEdgeIsSteeperThanASoftOneAndBothHaveTheSameContrast) {
  const auto edge = [](double width) {
    core::Picture picture = plain({0, 0, 0}, {128, 128});
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x) {
        const double v = std::clamp((x - 64) / width + 0.5, 0.0, 1.0);
        picture.set(x, y, {0.05 + 0.6 * v, 0.05 + 0.6 * v, 0.05 + 0.6 * v});
      }
    return qualities_of(picture);
  };
  EXPECT_GT(edge(4).hardness, 3 * edge(40).hardness);
  EXPECT_NEAR(edge(4).contrast, edge(40).contrast, 1);
}

TEST(Vocabulary, EveryWordIsUniqueMeasurableAndHasItsOpposite) {
  std::set<std::string> names;
  for (const Word& word : vocabulary()) {
    EXPECT_TRUE(names.insert(word.name).second) << word.name;
    if (!word.more.empty()) {
      EXPECT_TRUE(names.insert(word.more).second) << word.more;
    }
    EXPECT_FALSE(word.claims.empty()) << word.name;
    EXPECT_FALSE(word.meaning.empty()) << word.name;
    EXPECT_FALSE(word.nudge == Nudge{}) << word.name << " nudges nothing";
    const Word* opposite = word_called(word.opposite);
    ASSERT_NE(opposite, nullptr) << word.name;
    // More of one is never more of the other.
    const auto pull = [](const Nudge& a, const Nudge& b) {
      return a.brightness * b.brightness + a.warmth * b.warmth + a.contrast * b.contrast +
             a.softness * b.softness;
    };
    EXPECT_LT(pull(word.nudge, opposite->nudge), 0) << word.name;
  }
}

TEST(Vocabulary, AWordFitsWhatItClaimsAndItsOppositeDoesNot) {
  const Qualities night{.lightness = 12, .contrast = 40, .darkness = 0.85, .warmth = -0.5};
  const Qualities noon{.lightness = 80, .contrast = 20, .darkness = 0, .warmth = 0.3};
  for (const char* word : {"dark", "night", "mysterious", "cool"}) {
    EXPECT_GT(fit(*word_called(word), night), 0.7) << word;
    EXPECT_LT(fit(*word_called(word), noon), 0.1) << word;
  }
  for (const char* word : {"bright", "day", "airy"}) {
    EXPECT_LT(fit(*word_called(word), night), 0.1) << word;
    EXPECT_GT(fit(*word_called(word), noon), 0.7) << word;
  }
  EXPECT_EQ(word_called("warmer"), word_called("warm"));
  EXPECT_EQ(word_called("purple"), nullptr);
}

std::vector<Mood> three_moods() {
  std::vector<Mood> moods(3);
  moods[0].name = moods[0].title = "candle";
  moods[0].words = {"cosy"};
  moods[0].tags.tone = "low key";
  moods[1].name = moods[1].title = "noon";
  moods[1].sentence = "The sun stands high.";
  moods[2].name = moods[2].title = "moon";
  return moods;
}
const std::vector<Qualities> kThree{
    {.lightness = 20, .contrast = 40, .darkness = 0.7, .warmth = 1.6, .hardness = 8},
    {.lightness = 80, .contrast = 30, .darkness = 0, .warmth = 0.3, .hardness = 15},
    {.lightness = 20, .contrast = 30, .darkness = 0.8, .warmth = -0.8, .hardness = 8}};

std::string best(const std::string& words) {
  const auto moods = three_moods();
  return moods[search_moods(moods, kThree, words).matches.front().mood].name;
}

TEST(MoodSearch, FindsByWhatIsMeasured) {
  EXPECT_EQ(best("warm dark"), "candle");
  EXPECT_EQ(best("Bright"), "noon");
  EXPECT_EQ(best("a cool night"), "moon");
}

TEST(MoodSearch, WhatPeopleCallItCountsWhole) {
  const auto moods = three_moods();
  const MoodSearch cosy = search_moods(moods, kThree, "cosy");
  EXPECT_EQ(cosy.matches.front().mood, 0u);
  EXPECT_EQ(cosy.matches.front().score, 1);
  EXPECT_THAT(cosy.matches.front().because, Contains("said to be cosy"));
  EXPECT_EQ(best("low key"), "candle");
  EXPECT_EQ(best("sun"), "noon");
}

TEST(MoodSearch, EveryMoodIsInTheAnswerAndUnknownWordsAreNamed) {
  const auto moods = three_moods();
  const MoodSearch search = search_moods(moods, kThree, "wram xyzzy");
  EXPECT_EQ(search.matches.size(), 3u);
  ASSERT_EQ(search.unknown.size(), 2u);
  EXPECT_THAT(search.unknown[0], HasSubstr("did you mean warm"));
  EXPECT_EQ(search.unknown[1], "xyzzy");
  EXPECT_TRUE(search_moods({}, {}, "warm").matches.empty());
}

}  // namespace
}  // namespace chiaro::design
