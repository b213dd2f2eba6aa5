// SPDX-License-Identifier: Apache-2.0
#include "controller/patch/plan.h"

#include <gtest/gtest.h>

#include "tests/support/studios.h"

namespace chiaro::patch {
namespace {

using core::Dof;
using core::FixtureState;
using namespace std::chrono_literals;
using support::fixture_line;

FixtureState state(std::initializer_list<std::pair<Dof, double>> values) {
  FixtureState s;
  for (const auto& [dof, value] : values) s.set(dof, value);
  return s;
}

std::vector<ports::DmxFrame> encoded(const studio::Studio& studio,
                                     const std::vector<FixtureState>& states) {
  const Plan plan = Plan::of(studio);
  rig::Governor governor(studio, ports::TimePoint(1s));
  auto frames = plan.blank_frames();
  plan.encode(support::allow(governor, studio, states, ports::TimePoint(1s)), frames);
  return frames;
}

studio::Studio one(const std::string& profile, const std::string& mode, int address = 1,
                   const std::string& more = "") {
  return support::studio_from(
      support::studio_text(fixture_line("a", profile, mode, 1, address, more)));
}

/// A profile's channels that no shipped file has.
studio::Studio with_channels(std::vector<studio::Channel> channels, int footprint) {
  auto studio = one("generic/dimmer", "1ch");
  studio.fixtures[0].curve = {};
  studio.fixtures[0].profile.modes[0] = {"made up", footprint, std::move(channels)};
  return studio;
}

TEST(Plan, PutsTheLastSlotOfAUniverseWhereItBelongs) {
  const auto frames =
      encoded(one("generic/daylight-dimmer", "3ch-24bit", 510), {state({{Dof::intensity, 1}})});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].universe, 1);
  EXPECT_EQ(frames[1].universe, 2);
  EXPECT_EQ(frames[0].levels[508], 0);
  EXPECT_EQ(frames[0].levels[509], 255);
  EXPECT_EQ(frames[0].levels[511], 255);
}

TEST(Plan, SendsConstantsForEverAndNothingForHandsAndUnpatchedLamps) {
  studio::Channel strobe{"strobe", std::nullopt, 1, 0, 1.0, {}};
  studio::Channel level{"dimmer", Dof::intensity, 1, 1, 0, {}};
  auto studio = with_channels({strobe, level}, 2);
  EXPECT_EQ(encoded(studio, {FixtureState{}})[0].levels[0], 255);
  studio.fixtures[0].by_hand.push_back({Dof::intensity, studio::HandKind::knob, std::nullopt});
  EXPECT_EQ(encoded(studio, {state({{Dof::intensity, 1}})})[0].levels[1], 0);
  studio.fixtures[0].patch = studio::NoPatch{};
  EXPECT_EQ(encoded(studio, {state({{Dof::intensity, 1}})})[0].levels[0], 0);
}

TEST(Plan, SendsZeroForALampWithoutValues) {
  auto studio = one("generic/bicolour-panel", "4ch-16bit");
  studio.fixtures[0].controlled = false;
  const auto frames = encoded(studio, {FixtureState{}});
  for (const auto level : frames[0].levels) EXPECT_EQ(level, 0);
}

TEST(Plan, MeetsTheMiddleOfADeadBandAndStaysOutOfIt) {
  using Segment = studio::Segment;
  studio::Channel tint{"tint",
                       Dof::intensity,
                       1,
                       0,
                       0,
                       {{0, 100.0 / 255, 0, 0.5, Segment::Law::continuous},
                        {101.0 / 255, 151.0 / 255, 0.5, 0.5, Segment::Law::neutral},
                        {152.0 / 255, 1, 0.5, 1, Segment::Law::continuous}}};
  const auto studio = with_channels({tint}, 1);
  const auto byte = [&](double v) {
    return encoded(studio, {state({{Dof::intensity, v}})})[0].levels[0];
  };
  EXPECT_EQ(byte(0), 0);
  EXPECT_EQ(byte(0.25), 50);
  EXPECT_EQ(byte(1), 255);
  const auto middle = byte(0.5);
  EXPECT_TRUE(middle == 100 || middle == 126 || middle == 152) << int{middle};
}

TEST(Plan, DimsTheDrivesOfALampWithoutADimmer) {
  const auto studio = one("generic/rgb", "3ch");
  const auto frames = encoded(
      studio, {state({{Dof::intensity, 0.5}, {Dof::red, 1}, {Dof::green, 0.5}, {Dof::blue, 0}})});
  EXPECT_EQ(frames[0].levels[0], 128);  // 0.5 * 255 = 127.5, rounded away from zero
  EXPECT_EQ(frames[0].levels[1], 64);   // 63.75
  EXPECT_EQ(frames[0].levels[2], 0);
  std::vector<FixtureState> back(1);
  Plan::of(studio).decode(frames, back);
  EXPECT_NEAR(back[0].get(Dof::intensity), 128 / 255.0, 1e-12);
  EXPECT_NEAR(back[0].get(Dof::red), 1, 1e-12);
  EXPECT_NEAR(back[0].get(Dof::green), 0.5, 1e-12);
}

TEST(Plan, WarnsOfModbusForWhichThereIsNoDriverYet) {
  auto studio = one("generic/dimmer", "1ch");
  studio.fixtures[0].patch = studio::ModbusPatch{"rack", 3};
  core::Problems warnings;
  Plan::of(studio, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].warning);
  EXPECT_NE(warnings[0].what.find("'a' is patched to Modbus bus 'rack'"), std::string::npos);
}

TEST(Plan, ListsItsSheetByUniverseAndAddress) {
  const auto studio = support::studio_from(
      support::studio_text(fixture_line("b", "generic/bicolour-panel", "4ch-16bit", 2, 5) +
                           fixture_line("a", "generic/dimmer", "1ch", 1, 9)));
  const auto sheet = Plan::of(studio).sheet();
  ASSERT_EQ(sheet.size(), 3u);
  EXPECT_EQ(sheet[0].universe, 1);
  EXPECT_EQ(sheet[0].first, 9);
  EXPECT_EQ(sheet[2].first, 7);
  EXPECT_EQ(sheet[2].last, 8);
  EXPECT_EQ(sheet[2].law, "cct, 16 bit");
}

}  // namespace
}  // namespace chiaro::patch
