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

studio::Channel channel(const std::string& name, std::optional<Dof> dof, int offset,
                        std::vector<studio::Segment> segments = {}) {
  studio::Channel made;
  made.name = name;
  made.dof = dof;
  made.offset = offset;
  made.segments = std::move(segments);
  return made;
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
  studio::Channel strobe = channel("strobe", std::nullopt, 0);
  strobe.constant = 1;
  const studio::Channel level = channel("dimmer", Dof::intensity, 1);
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
  const studio::Channel tint = channel("tint", Dof::intensity, 0,
                                       {{0, 100.0 / 255, 0, 0.5, Segment::Law::continuous},
                                        {101.0 / 255, 151.0 / 255, 0.5, 0.5, Segment::Law::neutral},
                                        {152.0 / 255, 1, 0.5, 1, Segment::Law::continuous}});
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

TEST(Plan, SplitsAValueIntoACoarseStepAndATrimAndAddsThemUpAgain) {
  const auto studio = one("generic/two-mix-panel", "4ch-trim");
  const Plan plan = Plan::of(studio);
  for (int i = 0; i <= 1000; ++i) {
    const double level = i / 1000.0, kelvin = 2800 + 7.2 * i;
    const auto frames = encoded(studio, {state({{Dof::intensity, level}, {Dof::cct, kelvin}})});
    std::vector<FixtureState> back(1);
    plan.decode(frames, back);
    EXPECT_NEAR(back[0].get(Dof::intensity), level, 0.51 * 0.1 / 255);
    EXPECT_NEAR(back[0].get(Dof::cct), kelvin, 0.51);
  }
}

TEST(Plan, CountsAHeadsAnglesAsItHangs) {
  // Hung upside down the head counts pan the other way, and shows 20 and 40 degrees when it aims
  // at its neutral point: 30 degrees to the left and 10 up are its pan -10 and tilt 50.
  const auto studio = support::studio_from(support::studio_text(
      "  a: {role: key, profile: generic/moving-head, mode: 8ch, mount: {pan_tilt: {at: [-1, -1, "
      "3], "
      "aim_at: [0, 0, 1.4], neutral: {pan: 20 deg, tilt: 40 deg}, invert_pan: yes}}, patch: "
      "{universe: 1, address: 1}}\n"));
  const auto frames = encoded(studio, {state({{Dof::intensity, 1},
                                              {Dof::pan, core::radians(30)},
                                              {Dof::tilt, core::radians(10)}})});
  const auto raw = [&](std::size_t slot) {
    return 256 * frames[0].levels[slot] + frames[0].levels[slot + 1];
  };
  EXPECT_EQ(raw(0), 31554);  // (-10 + 270) / 540 * 65535 = 31553.9
  EXPECT_EQ(raw(2), 44904);  // (50 + 135) / 270 * 65535 = 44903.6
  std::vector<FixtureState> back(1);
  Plan::of(studio).decode(frames, back);
  EXPECT_NEAR(core::degrees(back[0].get(Dof::pan)), 30, 0.005);
  EXPECT_NEAR(core::degrees(back[0].get(Dof::tilt)), 10, 0.005);
}

TEST(Plan, MovesAnArcAndATrackOnTheirOwnChannels) {
  const auto studio = support::studio_from(support::studio_text(
      "  a: {role: key, profile: generic/dimmer, mode: 1ch, mount: {arc: {centre: [0, 0, 1.4], "
      "radius: 1.8 m, angle: [-80 deg, 80 deg], at: 0 deg, axis: {channel: 2, bits: 16}}}, patch: "
      "{universe: 1, address: 1}}\n"
      "  b: {role: back, profile: generic/dimmer, mode: 1ch, mount: {track: {from: [-2, 1, 2.5], "
      "to: "
      "[2, 1, 2.5], at: 50 %, axis: {channel: 2}}}, patch: {universe: 1, address: 4}}\n"));
  EXPECT_EQ(studio.fixtures[0].footprint(), 3);
  const auto frames = encoded(studio, {state({{Dof::intensity, 0}, {Dof::arc, core::radians(40)}}),
                                       state({{Dof::intensity, 0}, {Dof::track, 0.2}})});
  EXPECT_EQ(frames[0].levels[1], 0xbf);  // 0.75 * 65535 = 49151.25
  EXPECT_EQ(frames[0].levels[2], 0xff);
  EXPECT_EQ(frames[0].levels[4], 51);
  std::vector<FixtureState> back(2);
  Plan::of(studio).decode(frames, back);
  EXPECT_NEAR(core::degrees(back[0].get(Dof::arc)), 40, 0.002);
  EXPECT_NEAR(back[1].get(Dof::track), 0.2, 1e-9);
}

TEST(Plan, SwapsAHeadsAnglesWhereItsCablesAre) {
  // The head's pan channel tilts the lamp, downwards when it counts up; its tilt channel pans it.
  const auto studio = support::studio_from(support::studio_text(
      "  a: {role: key, profile: generic/moving-head, mode: 8ch, mount: {pan_tilt: {at: [-1, -1, "
      "3], aim_at: [0, 0, 1.4], tilt: [-120 deg, 120 deg], pan: [-130 deg, 130 deg], invert_tilt: "
      "yes, swap: yes}}, patch: {universe: 1, address: 1}}\n"));
  const auto frames = encoded(studio, {state({{Dof::intensity, 1},
                                              {Dof::pan, core::radians(27)},
                                              {Dof::tilt, core::radians(54)}})});
  const auto raw = [&](std::size_t slot) {
    return 256 * frames[0].levels[slot] + frames[0].levels[slot + 1];
  };
  EXPECT_EQ(raw(0), 26214);  // (-54 + 270) / 540 * 65535
  EXPECT_EQ(raw(2), 39321);  // (27 + 135) / 270 * 65535
  std::vector<FixtureState> back(1);
  Plan::of(studio).decode(frames, back);
  EXPECT_NEAR(core::degrees(back[0].get(Dof::pan)), 27, 0.005);
  EXPECT_NEAR(core::degrees(back[0].get(Dof::tilt)), 54, 0.005);
}

TEST(Plan, MovesAMotorAtAnAddressOfItsOwn) {
  const auto studio = support::studio_from(support::studio_text(
      "  a: {role: key, profile: generic/dimmer, mode: 1ch, mount: {track: {from: [-2, 1, 2.5], "
      "to: [2, 1, 2.5], at: 50 %, axis: {universe: 2, address: 3}}}, patch: {universe: 1, address: "
      "1}}\n"));
  EXPECT_EQ(studio.fixtures[0].footprint(), 1);
  const Plan plan = Plan::of(studio);
  ASSERT_EQ(plan.universes().size(), 2u);
  const auto frames = encoded(studio, {state({{Dof::intensity, 0}, {Dof::track, 0.25}})});
  EXPECT_EQ(frames[1].levels[2], 0x40);  // 0.25 * 65535 = 16383.75
  EXPECT_EQ(frames[1].levels[3], 0x00);
  std::vector<FixtureState> back(1);
  plan.decode(frames, back);
  EXPECT_NEAR(back[0].get(Dof::track), 0.25, 1e-5);
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
