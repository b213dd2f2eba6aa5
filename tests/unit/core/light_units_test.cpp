// SPDX-License-Identifier: Apache-2.0
#include "controller/core/light_units.h"

#include <cmath>
#include <gtest/gtest.h>

namespace chiaro::core {
namespace {

TEST(LightUnits, AFootCandleIsTenPointSevenSixLux) {
  EXPECT_NEAR(lux_of_foot_candles(1).value, 10.7639, 1e-4);
  EXPECT_NEAR(foot_candles(Lux{1000}), 92.903, 1e-3);
  EXPECT_NEAR(foot_candles(lux_of_foot_candles(64)), 64, 1e-12);
}

TEST(LightUnits, AnIncidentMeterFollowsItsConstant) {
  // f/2.8 (exactly 2^1.5) at 1/50 s and ISO 100: E = 250 * 8 * 50 / 100 = 1000 lx.
  EXPECT_NEAR(lux_for({std::exp2(1.5), 1.0 / 50, 100}).value, 1000, 1e-9);
  EXPECT_NEAR(aperture_for(Lux{1000}, 1.0 / 50, 100), std::exp2(1.5), 1e-12);
  EXPECT_EQ(aperture_for(Lux{0}, 1.0 / 50, 100), 0);
  // f/8 at ISO 100 on a flash meter: H = 250 * 64 / 100 = 160 lux seconds.
  EXPECT_NEAR(lux_seconds_for(8, 100), 160, 1e-12);
}

TEST(LightUnits, OneStopOnTheMeterIsTwiceTheCandela) {
  const double one = candela_from(CameraSetting{4, 1.0 / 50, 100}, 2).value;
  EXPECT_NEAR(one, 250 * 16 * 50 / 100.0 * 4, 1e-9);  // 2000 lx at 2 m
  EXPECT_NEAR(candela_from(CameraSetting{4 * std::sqrt(2), 1.0 / 50, 100}, 2).value, 2 * one, 1e-9);
  EXPECT_NEAR(candela_from(CameraSetting{4, 1.0 / 50, 200}, 2).value, one / 2, 1e-9);
  EXPECT_NEAR(candela_from(Lux{500}, 3).value, 4500, 1e-9);
}

TEST(LightUnits, ASoftboxIsNoPointFromItsOwnWidth) {
  EXPECT_TRUE(near_field(1.2, 0.9));
  EXPECT_FALSE(near_field(4.6, 0.9));
}

TEST(LightUnits, FlashPowersAreThirdsDownToA128th) {
  const auto powers = flash_powers();
  ASSERT_EQ(powers.size(), 22u);
  EXPECT_EQ(powers.front(), 1);
  EXPECT_NEAR(powers.back(), 1.0 / 128, 1e-12);
  EXPECT_NEAR(*nearest_flash_power(0.26), 0.25, 1e-12);
  EXPECT_NEAR(*nearest_flash_power(1.0 / 130), 1.0 / 128, 1e-12);
  EXPECT_FALSE(nearest_flash_power(1.0 / 150));
  EXPECT_FALSE(nearest_flash_power(0));
}

TEST(LightWords, FlashPowersAsTheirDisplaysShowThem) {
  EXPECT_EQ(flash_power_in_words(1), "full power");
  EXPECT_EQ(flash_power_in_words(std::exp2(-7.0 / 3)), "1/4 - ⅓ power");
  EXPECT_EQ(flash_power_in_words(std::exp2(-2.0 / 3)), "1/1 - ⅔ power");
  EXPECT_EQ(flash_power_in_words(1.0 / 128), "1/128 power");
  EXPECT_EQ(flash_power_in_words(1.0 / 300), "off");
}

TEST(LightWords, LevelsInPerCentAndStops) {
  EXPECT_EQ(level_and_stops(1), "full");
  EXPECT_EQ(level_and_stops(0.5), "50 % (1 stop below full)");
  EXPECT_EQ(level_and_stops(0.315), "32 % (1⅔ stops below full)");
  EXPECT_EQ(level_and_stops(0.95), "95 %");
  EXPECT_EQ(level_and_stops(0), "dark");
}

TEST(LightWords, IlluminanceInBothUnits) {
  EXPECT_EQ(illuminance_in_words(Lux{420}), "420 lx (39 fc)");
  EXPECT_EQ(illuminance_in_words(Lux{1234}), "1230 lx (110 fc)");
  EXPECT_EQ(illuminance_in_words(Lux{3.21}), "3.21 lx (0.3 fc)");
  EXPECT_EQ(illuminance_in_words(Lux{0}), "0 lx (0 fc)");
}

TEST(LightWords, WhitesWithTheirGreen) {
  EXPECT_EQ(white_in_words(Kelvin{5604}), "5600 K");
  EXPECT_EQ(white_in_words(Kelvin{5600}, 4.2), "5600 K, +4 green");
  EXPECT_EQ(white_in_words(Kelvin{3200}, -3), "3200 K, -3 green (magenta)");
}

TEST(LightWords, RatiosBrighterFirst) {
  EXPECT_EQ(ratio_in_words(4), "4:1 (2 stops)");
  EXPECT_EQ(ratio_in_words(0.25), "4:1 (2 stops)");
  EXPECT_EQ(ratio_in_words(2.52), "2.5:1 (1⅓ stops)");
  EXPECT_EQ(ratio_in_words(1.02), "1:1 (even)");
}

TEST(LightWords, DistancesForBothTapeMeasures) {
  EXPECT_EQ(distance_in_words(1.6), "1.6 m (5 ft 3 in)");
  EXPECT_EQ(distance_in_words(0.2), "0.2 m (8 in)");
  EXPECT_EQ(distance_in_words(6 * kMetresPerFoot), "1.83 m (6 ft)");
}

TEST(LightWords, PlacesAsAGafferSaysThem) {
  EXPECT_EQ(place_in_words({radians(-47), radians(38), 1.6}), "47° camera left, 38° up, 1.6 m");
  EXPECT_EQ(azimuth_in_words(0), "at the camera's azimuth");
  EXPECT_EQ(azimuth_in_words(kPi), "straight behind");
  EXPECT_EQ(elevation_in_words(radians(-12)), "12° down");
}

TEST(LightWords, CamerasShowEngravedMarks) {
  EXPECT_EQ(setting_in_words({4, 1.0 / 50, 100}), "f/4 at 1/50 s, ISO 100");
  EXPECT_EQ(aperture_in_words(std::exp2(2.5)), "f/5.6");
  EXPECT_EQ(aperture_in_words(std::exp2(1.5 + 1.0 / 6)), "f/3.2");
  EXPECT_EQ(shutter_in_words(0.5), "0.5 s");
}

TEST(MeterReading, IsReadAsPeopleTypeIt) {
  EXPECT_NEAR(meter_reading("420 lx")->value, 420, 1e-9);
  EXPECT_NEAR(meter_reading("1.2 klx")->value, 1200, 1e-9);
  EXPECT_NEAR(meter_reading("39fc")->value, 39 / (0.3048 * 0.3048), 1e-9);
  const double at_f4 = 250 * 16 * 50 / 100.0;
  EXPECT_NEAR(meter_reading("f/4 at 1/50 s, ISO 100")->value, at_f4, 1e-9);
  EXPECT_NEAR(meter_reading("ISO100 1/50 F4")->value, at_f4, 1e-9);
}

TEST(MeterReading, RefusesWhatIsNone) {
  for (const char* text : {"", "bright", "f/4", "f/4 1/50", "-3 lx", "420", "f/4 1/0 iso 100",
                           "f/4 f/5.6 1/50 ISO 100", "nan lx", "f/4 1/50 ISO"})
    EXPECT_FALSE(meter_reading(text)) << text;
}

}  // namespace
}  // namespace chiaro::core
