// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/words.h"

#include <gtest/gtest.h>

namespace chiaro::studio {
namespace {

core::Spherical place(double azimuth, double elevation, double distance) {
  return {core::radians(azimuth), core::radians(elevation), distance};
}

TEST(Words, AzimuthIsNegativeOnTheCamerasLeft) {
  EXPECT_EQ(place_in_words(place(-47, 38, 1.6)), "47° camera left, 38° up, 1.60 m");
  EXPECT_EQ(place_in_words(place(40, -10, 2)), "40° camera right, 10° down, 2.00 m");
}

TEST(Words, TheAxesHaveWordsOfTheirOwn) {
  EXPECT_EQ(place_in_words(place(0.2, -0.3, 2)), "straight in front, level, 2.00 m");
  EXPECT_EQ(place_in_words(place(-180, 30, 1.5)), "straight behind, 30° up, 1.50 m");
  EXPECT_EQ(place_in_words(place(-145, 30, 1.6)), "145° camera left (behind), 30° up, 1.60 m");
}

TEST(Words, WhatIsSaidIsUnderstood) {
  for (double azimuth = -180; azimuth <= 180; azimuth += 9)
    for (double elevation = -90; elevation <= 90; elevation += 15) {
      const auto said = place_in_words(place(azimuth, elevation, 1.85));
      const auto heard = place_from_words(said);
      ASSERT_TRUE(heard.ok()) << said;
      const double turn = core::degrees(heard->azimuth) - azimuth;
      EXPECT_NEAR(std::remainder(turn, 360), 0, 1e-9) << said;
      EXPECT_NEAR(core::degrees(heard->elevation), elevation, 1e-9) << said;
      EXPECT_DOUBLE_EQ(heard->distance, 1.85) << said;
    }
}

TEST(Words, AsPeopleTypeIt) {
  const core::Spherical expected = place(-47, 38, 1.6);
  for (const char* words : {"47 left, 38 up, 1.6 m", "38 up 47 left 160cm", "1.6m, 47° Left,38° UP",
                            "47 degrees camera left and 38 degrees up, 1.6 metres away"}) {
    const auto heard = place_from_words(words);
    ASSERT_TRUE(heard.ok()) << words;
    EXPECT_NEAR(heard->azimuth, expected.azimuth, 1e-12) << words;
    EXPECT_NEAR(heard->elevation, expected.elevation, 1e-12) << words;
    EXPECT_NEAR(heard->distance, expected.distance, 1e-12) << words;
  }
}

TEST(Words, WhatIsMissingIsAskedFor) {
  const auto said = [](const char* words) {
    const auto heard = place_from_words(words);
    return heard.ok() ? "" : heard.problems().front().what;
  };
  EXPECT_EQ(said(""), "how far left or right of the camera is it?");
  EXPECT_EQ(said("47 left"), "how far up or down is it?");
  EXPECT_EQ(said("47 left, level"), "how many metres from the sitter is it?");
  EXPECT_EQ(said("left, 38 up, 1 m"), "how many degrees left?");
  EXPECT_EQ(said("47, 38, 1.6"), "what is 47?");
  EXPECT_EQ(said("47 left, 38 up, 1.6"), "what is 1.6?");
  EXPECT_EQ(said("over there"), "what does 'over' mean?");
  EXPECT_EQ(said("190 left, 38 up, 1 m"), "left and right go to 180 degrees");
  EXPECT_EQ(said("10 left, 95 up, 1 m"), "up and down go to 90 degrees");
  EXPECT_EQ(said("10 left, 5 up, 0 m"), "the distance must be between 0 and 100 m");
}

TEST(Words, AddressesAsPatchSheetsPrintThem) {
  Fixture fixture;
  fixture.profile.modes = {{"4ch", 4, {}}, {"1ch", 1, {}}};
  fixture.patch = DmxPatch{1, 9};
  EXPECT_EQ(patch_in_words(fixture), "1.009-012");
  fixture.mode = 1;
  EXPECT_EQ(patch_in_words(fixture), "1.009");
  fixture.patch = ModbusPatch{"rail", 40};
  EXPECT_EQ(patch_in_words(fixture), "rail: 40");
  fixture.patch = NoPatch{};
  EXPECT_EQ(patch_in_words(fixture), "by hand");
  fixture.controlled = false;
  EXPECT_EQ(patch_in_words(fixture), "not controlled");
}

TEST(Words, LimitsAndOutput) {
  EXPECT_EQ(limits_in_words({}), "none");
  EXPECT_EQ(limits_in_words({0.8, 0.5, 0.1, true}),
            "at most 80 %, dark to full in 2 s, safe at 10 %, house light: stays on in blackout");
  Fixture fixture;
  fixture.output = {12000};
  EXPECT_EQ(output_in_words(fixture), "12000 cd");
  fixture.modifiers = {{"softbox", 0.6, 0.9, 1}};
  EXPECT_EQ(output_in_words(fixture), "6000 cd, softbox 0.6 x 0.9 m");
}

}  // namespace
}  // namespace chiaro::studio
