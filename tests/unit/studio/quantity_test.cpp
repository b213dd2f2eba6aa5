// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/quantity.h"

#include <gtest/gtest.h>

#include "controller/core/units.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {
namespace {

double value(const char* text, Measure measure) {
  const Parsed parsed = parse_quantity(text, measure);
  EXPECT_TRUE(parsed.value) << text;
  return parsed.value.value_or(-1e9);
}

TEST(Quantity, EveryUnitInInsideUnits) {
  EXPECT_DOUBLE_EQ(value("0.6 m", Measure::length), 0.6);
  EXPECT_DOUBLE_EQ(value("62 cm", Measure::length), 0.62);
  EXPECT_DOUBLE_EQ(value("5 mm", Measure::length), 0.005);
  EXPECT_DOUBLE_EQ(value("10 ft", Measure::length), 3.048);
  EXPECT_DOUBLE_EQ(value("100 in", Measure::length), 2.54);
  EXPECT_DOUBLE_EQ(value("180 deg", Measure::angle), core::kPi);
  EXPECT_DOUBLE_EQ(value("180°", Measure::angle), core::kPi);
  EXPECT_DOUBLE_EQ(value("1.5 rad", Measure::angle), 1.5);
  EXPECT_DOUBLE_EQ(value("40 Hz", Measure::frequency), 40);
  EXPECT_DOUBLE_EQ(value("1.5 s", Measure::duration), 1.5);
  EXPECT_DOUBLE_EQ(value("250 ms", Measure::duration), 0.25);
  EXPECT_DOUBLE_EQ(value("2 min", Measure::duration), 120);
  EXPECT_DOUBLE_EQ(value("1/50 s", Measure::duration), 0.02);
  EXPECT_DOUBLE_EQ(value("5600 K", Measure::temperature), 5600);
  EXPECT_DOUBLE_EQ(value("800 lx", Measure::illuminance), 800);
  EXPECT_NEAR(value("1 fc", Measure::illuminance), 1 / (0.3048 * 0.3048), 1e-9);
  EXPECT_DOUBLE_EQ(value("12 kcd", Measure::intensity), 12000);
  EXPECT_DOUBLE_EQ(value("1 stop", Measure::stops), 1);
  EXPECT_DOUBLE_EQ(value("-1.3 stops", Measure::stops), -1.3);
}

TEST(Quantity, SpacesAndSignsDoNotMatter) {
  EXPECT_DOUBLE_EQ(value("  +26deg ", Measure::angle), core::radians(26));
  EXPECT_DOUBLE_EQ(value("1e3 cd", Measure::intensity), 1000);
}

TEST(Quantity, WhyItCannotBeRead) {
  EXPECT_EQ(parse_quantity("26", Measure::angle).why, Misread::no_unit);
  EXPECT_EQ(parse_quantity("26 Hz", Measure::angle).why, Misread::wrong_unit);
  EXPECT_EQ(parse_quantity("26 degs", Measure::angle).why, Misread::unknown_unit);
  for (const char* text : {"", "deg", "nan deg", "inf deg", "1e999 deg", "--1 deg", "0x10 deg"})
    EXPECT_FALSE(parse_quantity(text, Measure::angle).value) << text;
  for (const char* text : {"1/0 s", "1/ s", "/2 s"})
    EXPECT_FALSE(parse_quantity(text, Measure::duration).value) << text;
  EXPECT_FALSE(parse_quantity("1/2 m", Measure::length).value);
}

TEST(Quantity, WrittenBackInItsFirstUnit) {
  EXPECT_EQ(written(Measure::angle, core::radians(26)), "26 deg");
  EXPECT_EQ(written(Measure::length, 0.62), "0.62 m");
  EXPECT_EQ(written(Measure::temperature, 5600), "5600 K");
}

TEST(Text, QuotesAreCutBetweenCharactersAndHideControls) {
  EXPECT_EQ(in_quotes("a\x1b[2J"), "'a?[2J'");
  std::string accents;
  for (int i = 0; i < 60; ++i) accents += "é";
  EXPECT_FALSE(first_byte_not_text(in_quotes("x" + accents)));
  EXPECT_FALSE(first_byte_not_text(in_quotes(accents)));
}

TEST(Text, WhatIsUtf8AndWhatIsNot) {
  EXPECT_FALSE(first_byte_not_text("plain, é, ° and 😀\n"));
  for (const char* bad :
       {"\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80", "\x7f"})
    EXPECT_EQ(first_byte_not_text(bad), std::size_t{0});
}

}  // namespace
}  // namespace chiaro::studio::reading
