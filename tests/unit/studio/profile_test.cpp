// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "controller/studio/profiles/profiles.h"

namespace chiaro::studio::profiles {
namespace {

std::string with(const std::string& rest) {
  return "profile: a/b\nmaker: A\nmodel: B\noutput: 1000 cd\noptic: point\n" + rest;
}
constexpr const char* kDimmer = "emitter: {dimmer: {cct: 3200 K}}\n";
constexpr const char* kBicolour = "emitter: {bicolour: {cct: [2700 K, 6500 K], tint: [-10, 10]}}\n";

Profile good(const std::string& rest) {
  const auto profile = parse_profile(with(rest), "a/b", "b.yaml");
  EXPECT_TRUE(profile.ok()) << core::to_string(profile.problems());
  return profile.ok() ? *profile : Profile{};
}
std::string wrong(const std::string& rest) {
  return core::to_string(parse_profile(with(rest), "a/b", "b.yaml").problems());
}

TEST(ProfileFile, ChannelsFollowOneAnotherSlotAfterSlot) {
  const Profile profile =
      good(std::string(kBicolour) +
           "modes:\n  m:\n    - {controls: intensity, bits: 24}\n"
           "    - {name: strobe, constant: 51}\n    - {controls: cct, bits: 16}\n");
  ASSERT_EQ(profile.modes.size(), 1u);
  const Mode& mode = profile.modes[0];
  EXPECT_EQ(mode.footprint, 6);
  EXPECT_EQ(mode.channels[0].bytes, 3);
  EXPECT_EQ(mode.channels[1].offset, 3);
  EXPECT_FALSE(mode.channels[1].dof);
  EXPECT_DOUBLE_EQ(mode.channels[1].constant, 0.2);
  EXPECT_EQ(mode.channels[2].offset, 4);
  ASSERT_EQ(mode.channels[2].segments.size(), 1u);
  EXPECT_DOUBLE_EQ(mode.channels[2].segments[0].physical_from, 2700);
  EXPECT_DOUBLE_EQ(mode.channels[2].segments[0].physical_to, 6500);
}

TEST(ProfileFile, ASlotMayBeNamedAndLeaveAGap) {
  const Profile profile =
      good(std::string(kDimmer) + "modes: {m: [{controls: intensity, slot: 5}]}\n");
  EXPECT_EQ(profile.modes[0].channels[0].offset, 4);
  EXPECT_EQ(profile.modes[0].footprint, 5);
}

TEST(ProfileFile, RangesInRawValuesOfTheChannelsOwnResolution) {
  const Profile profile =
      good(std::string(kBicolour) +
           "modes:\n  m:\n    - {controls: intensity}\n    - controls: tint\n      bits: 16\n"
           "      ranges:\n        - {dmx: [0, 2570], neutral: 0}\n"
           "        - {dmx: [2571, 65535], means: [-10, 10]}\n");
  const auto& segments = profile.modes[0].channels[1].segments;
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].law, Segment::Law::neutral);
  EXPECT_DOUBLE_EQ(segments[0].dmx_to, 2570.0 / 65535);
  EXPECT_DOUBLE_EQ(segments[0].physical_from, 0);
  EXPECT_DOUBLE_EQ(segments[1].physical_from, -10);
  EXPECT_DOUBLE_EQ(segments[1].dmx_to, 1);
}

TEST(ProfileFile, AColourTemperatureMayRunBackwards) {
  const Profile profile =
      good(std::string(kBicolour) +
           "modes:\n  m:\n    - {controls: intensity}\n    - {controls: cct, ranges: [{dmx: [0, "
           "255], means: [6500 K, 2700 K]}]}\n");
  EXPECT_DOUBLE_EQ(profile.modes[0].channels[1].segments[0].physical_from, 6500);
}

TEST(ProfileFile, EveryOptic) {
  const auto optic = [](const std::string& words) {
    const auto profile =
        parse_profile("profile: a/b\nmaker: A\nmodel: B\noutput: 1 kcd\noptic: " + words + "\n" +
                          kDimmer + "modes: {m: [{controls: intensity}]}\n",
                      "a/b", "b.yaml");
    EXPECT_TRUE(profile.ok()) << core::to_string(profile.problems());
    return profile.ok() ? profile->optic : Optic{};
  };
  EXPECT_EQ(optic("point").kind, Optic::Kind::point);
  EXPECT_EQ(optic("directional").kind, Optic::Kind::directional);
  EXPECT_DOUBLE_EQ(optic("{spot: {beam: 20 deg, field: 40 deg}}").field, core::radians(40));
  EXPECT_DOUBLE_EQ(optic("{rectangle: [0.3, 0.5]}").height, 0.5);
  EXPECT_DOUBLE_EQ(optic("{disk: {radius: 20 cm}}").radius, 0.2);
}

TEST(ProfileFile, EveryCurve) {
  const auto curve = [](const std::string& words) {
    return good(std::string(kDimmer) + "curve: " + words +
                "\nmodes: {m: [{controls: intensity}]}\n")
        .curve;
  };
  EXPECT_EQ(curve("linear").law, DimmerCurve::Law::linear);
  EXPECT_EQ(curve("square").law, DimmerCurve::Law::square);
  EXPECT_EQ(curve("s_curve").law, DimmerCurve::Law::s_curve);
  EXPECT_DOUBLE_EQ(curve("{gamma: 1.8}").gamma, 1.8);
  EXPECT_EQ(curve("{table: [0, 0.5, 1]}").table, (std::vector<double>{0, 0.5, 1}));
}

TEST(ProfileFile, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_EQ(wrong(std::string(kDimmer) + "modes: {m: [{controls: cct}]}\n"),
            "b.yaml:7:13: what the raw values of 'cct' mean is not known (add ranges: [{dmx: [0, "
            "255], means: [from, to]}], or give the lamp that setting)\n");
  EXPECT_EQ(wrong(std::string(kDimmer) + "modes: {m: [{constant: 0}]}\n"),
            "b.yaml:7:12: no channel of this mode controls light (add {controls: intensity}, or a "
            "colour of a mixed emitter)\n");
  EXPECT_EQ(
      wrong(std::string(kDimmer) +
            "modes: {m: [{controls: intensity, bits: 16}, {constant: 0, slot: 2}]}\n"),
      "b.yaml:7:12: two channels of this mode share slot 2 (a 16 bit channel takes two slots, "
      "a 24 bit channel three)\n");
  EXPECT_EQ(
      wrong(std::string(kDimmer) + "modes: {m: [{controls: intensity}, {controls: intensity}]}\n"),
      "b.yaml:7:12: two channels of this mode control 'intensity' (write a fine channel as one "
      "channel with bits: 16)\n");
  EXPECT_EQ(wrong("emitter: {mixed: {red: {chromaticity: [0.69, 0.31], share: 0.5}, blue: "
                  "{chromaticity: [0.14, 0.05], share: 0.2}}}\nmodes: {m: [{controls: red}]}\n"),
            "b.yaml:6:18: the shares of the emitters add up to 0.7, expected 1 (each share is that "
            "emitter's part of the light when all are full)\n");
  EXPECT_EQ(wrong(std::string(kBicolour) +
                  "modes: {m: [{controls: intensity}, {controls: cct, ranges: [{dmx: [0, 200], "
                  "means: [2700 K, 6500 K]}, {dmx: [150, 255], means: [6500 K, 7000 K]}]}]}\n"),
            "b.yaml:7:103: this range overlaps the one before, or stands below it (list the ranges "
            "from the lowest raw value to the highest)\n");
  EXPECT_EQ(wrong(std::string(kBicolour) +
                  "modes: {m: [{controls: intensity}, {controls: cct, ranges: [{dmx: [0, 100], "
                  "means: [2700 K, 6500 K]}, {dmx: [101, 255], means: [6500 K, 3000 K]}]}]}\n"),
            "b.yaml:7:60: the meaning of this channel goes up and down (it must only rise or only "
            "fall, else one wish has two raw values)\n");
}

TEST(ProfileFile, AChannelMayTrimRepeatStandOpenOrHoldAFrequency) {
  const Profile profile =
      good(std::string(kBicolour) +
           "modes:\n  m:\n    - {controls: intensity}\n"
           "    - {trims: intensity, ranges: [{dmx: [0, 255], means: [0 %, 10 %]}]}\n"
           "    - {repeats: intensity}\n    - {open: 51}\n"
           "    - {pwm: 2400 Hz, ranges: [{dmx: [0, 255], means: [300 Hz, 5400 Hz]}]}\n"
           "    - {controls: cct, slots: [6, 9], rest: 65535}\n");
  const auto& channels = profile.modes[0].channels;
  ASSERT_EQ(channels.size(), 6u);
  EXPECT_EQ(channels[1].use, ChannelUse::trims);
  EXPECT_DOUBLE_EQ(channels[1].segments[0].physical_to, 0.1);
  EXPECT_EQ(channels[2].use, ChannelUse::repeats);
  EXPECT_EQ(channels[3].use, ChannelUse::open);
  EXPECT_DOUBLE_EQ(channels[3].constant, 0.2);
  EXPECT_EQ(channels[4].use, ChannelUse::pwm);
  EXPECT_NEAR(channels[4].constant, 2100.0 / 5100, 1e-12);
  EXPECT_DOUBLE_EQ(channels[4].pwm_hz, 2400);
  EXPECT_EQ(channels[5].slot(0), 5);
  EXPECT_EQ(channels[5].slot(1), 8);
  EXPECT_EQ(channels[5].rest, 1.0);
  EXPECT_EQ(profile.modes[0].footprint, 9);
}

TEST(ProfileFile, WhatFollowsNeedsSomethingToFollow) {
  EXPECT_EQ(
      wrong(std::string(kBicolour) +
            "modes: {m: [{controls: intensity}, {trims: cct, ranges: [{dmx: [0, 255], means: [0 "
            "K, 255 K]}]}]}\n"),
      "b.yaml:7:12: no channel of this mode controls 'cct', yet one follows it (write "
      "{controls: …} for the first or coarse one)\n");
}

TEST(ProfileFile, ASpectrumIsAColour) {
  const Profile profile = good(
      "emitter: {mixed: {red: {spectrum: [[620, 0], [630, 1], [640, 0]], share: 0.3}, white: "
      "{spectrum: [[380, 1], [780, 1]], share: 0.7}}}\nmodes: {m: [{controls: red}, {controls: "
      "white}]}\n");
  // A narrow red near 630 nm lies at CIE x 0.71, y 0.29; equal energy at 1/3, 1/3.
  EXPECT_NEAR(profile.emitter.primaries[0].chromaticity.x, 0.708, 0.01);
  EXPECT_NEAR(profile.emitter.primaries[0].chromaticity.y, 0.292, 0.01);
  EXPECT_NEAR(profile.emitter.primaries[1].chromaticity.x, 1.0 / 3, 0.01);
  EXPECT_NEAR(profile.emitter.primaries[1].chromaticity.y, 1.0 / 3, 0.01);
}

TEST(ProfileFile, ABlendHasWhitesColoursAndAFadeBetweenThem) {
  const Profile profile = good(
      "emitter: {blend: {cct: [2800 K, 10000 K], red: {chromaticity: [0.69, 0.31], share: 0.4}, "
      "green: {chromaticity: [0.17, 0.7], share: 0.6}}}\nmodes: {m: [{controls: intensity}, "
      "{controls: cct}, {controls: crossfade}, {controls: red}, {controls: green}]}\n");
  EXPECT_EQ(profile.emitter.kind, Emitter::Kind::blend);
  EXPECT_DOUBLE_EQ(profile.modes[0].channels[2].segments[0].physical_to, 1);
  EXPECT_DOUBLE_EQ(profile.modes[0].channels[1].segments[0].physical_from, 2800);
}

TEST(ProfileFile, ItsNameIsItsPath) {
  const auto profile = parse_profile(
      with(std::string(kDimmer) + "modes: {m: [{controls: intensity}]}\n"), "a/c", "c.yaml");
  ASSERT_FALSE(profile.ok());
  EXPECT_EQ(core::to_string(profile.problems()),
            "c.yaml:1:10: this profile calls itself 'a/b', its file is 'a/c' (a profile's name is "
            "its path below the fixtures folder)\n");
}

}  // namespace
}  // namespace chiaro::studio::profiles
