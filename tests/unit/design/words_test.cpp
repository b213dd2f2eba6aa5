// SPDX-License-Identifier: Apache-2.0
#include "controller/design/words.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/design/design.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

core::Spherical at(double azimuth, double elevation, double distance) {
  return {core::radians(azimuth), core::radians(elevation), distance};
}

TEST(Words, PlacesAsAGafferSaysThem) {
  EXPECT_EQ(place_in_words(at(-47, 38, 1.6)), "47° camera left, 38° up, 1.6 m");
  EXPECT_EQ(place_in_words(at(30.4, -12, 2)), "30° camera right, 12° down, 2 m");
  EXPECT_EQ(place_in_words(at(0, 0, 1.25)), "at the camera's azimuth, 0° up, 1.25 m");
  EXPECT_EQ(place_in_words(at(180, 45, 1.4)), "straight behind, 45° up, 1.4 m");
  EXPECT_EQ(place_in_words(at(200, 10, 1)), "160° camera left, 10° up, 1 m");
}

TEST(Words, StopsInThirds) {
  EXPECT_EQ(stops_in_words(1.3), "1⅓ stops");
  EXPECT_EQ(stops_in_words(-0.7), "⅔ stop");
  EXPECT_EQ(stops_in_words(1), "1 stop");
  EXPECT_EQ(stops_in_words(2), "2 stops");
  EXPECT_EQ(stops_in_words(0.05), "0 stops");
}

TEST(Words, FlashPowersAsTheirDisplaysShowThem) {
  EXPECT_EQ(flash_power_in_words(1), "full power");
  EXPECT_EQ(flash_power_in_words(0.25), "1/4 power");
  EXPECT_EQ(flash_power_in_words(std::exp2(-7.0 / 3)), "1/4 - ⅓ power");
  EXPECT_EQ(flash_power_in_words(std::exp2(-2.0 / 3)), "1/1 - ⅔ power");
  EXPECT_EQ(flash_power_in_words(0), "off");
}

TEST(Words, NumbersWithoutNeedlessZeros) {
  EXPECT_EQ(number(1.6, 2), "1.6");
  EXPECT_EQ(number(2.0, 2), "2");
  EXPECT_EQ(number(-0.001, 2), "0");
  EXPECT_EQ(number(100, 0), "100");
}

TEST(Instructions, AreForPeopleOnly) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key, at(-40, 30, 2.2), 3000),
                     support::stand_lamp("fill", studio::Role::fill, at(40, 10, 2), 3000),
                     support::fixed_lamp("flash", studio::Role::back, {0.8, 1.1, 2.3}, 3000),
                     support::fixed_lamp("panel", studio::Role::background, {0, 0.9, 0.2}, 800)};
  studio.fixtures[1].by_hand = {{core::Dof::intensity, studio::HandKind::knob, {}}};
  studio.fixtures[2].by_hand = {{core::Dof::intensity, studio::HandKind::flash_power, {}}};
  const studio::Rig now = studio::placed_rig(studio);
  studio::Rig wanted = now;
  support::stand(wanted, 0, -47, 38, 1.6, 0.5);
  support::stand(wanted, 1, 41, 10.5, 2.02, 0.35);  // near enough to stay
  wanted.states[2].set(core::Dof::intensity, 0.25);
  wanted.states[3].set(core::Dof::intensity, 0.5);
  EXPECT_EQ(instructions(studio, now, wanted),
            (std::vector<std::string>{"move key to 47° camera left, 38° up, 1.6 m from the face",
                                      "set fill's knob to 35 %", "set flash to 1/4 power"}));
}

TEST(Ratio, IsIncidentAtTheFaceEachAlone) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key, at(-40, 30, 2), 4000),
                     support::stand_lamp("fill", studio::Role::fill, at(40, 10, 1), 1000)};
  studio::Rig rig = studio::placed_rig(studio);
  support::stand(rig, 0, -40, 30, 2, 0.8);
  support::stand(rig, 1, 40, 10, 1, 0.2);
  ASSERT_TRUE(key_fill_ratio(studio, rig).has_value());
  EXPECT_NEAR(*key_fill_ratio(studio, rig), (4000 * 0.8 / 4) / (1000 * 0.2), 1e-9);
  rig.states[1].set(core::Dof::intensity, 0);
  EXPECT_FALSE(key_fill_ratio(studio, rig).has_value());
}

TEST(MixedLight, FlashAndContinuousTogetherAreSaid) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::fixed_lamp("flash", studio::Role::key, {0.8, -1.1, 2.3}, 3000),
                     support::fixed_lamp("panel", studio::Role::fill, {-1, -0.9, 1.2}, 800)};
  studio.fixtures[0].by_hand = {{core::Dof::intensity, studio::HandKind::flash_power, {}}};
  studio::Rig rig = studio::placed_rig(studio);
  rig.states[0].set(core::Dof::intensity, 0.5);
  rig.states[1].set(core::Dof::intensity, 0);
  EXPECT_EQ(mixed_light_in_words(studio, rig), "");
  rig.states[1].set(core::Dof::intensity, 0.3);
  const std::string words = mixed_light_in_words(studio, rig);
  EXPECT_NE(words.find("flash (flash) and continuous light (panel)"), std::string::npos) << words;
  studio.cameras.front().shutter_s = 1.0 / 125;
  EXPECT_NE(mixed_light_in_words(studio, rig).find("1/125 s"), std::string::npos);
  rig.states[0].set(core::Dof::intensity, 0);
  EXPECT_EQ(mixed_light_in_words(studio, rig), "");
}

}  // namespace
}  // namespace chiaro::design
