// SPDX-License-Identifier: Apache-2.0
// What a fixture gives as fitted, patched and mounted; the values by hand.
#include <cmath>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"
#include "tests/support/studios.h"

namespace chiaro::studio {
namespace {

using core::Dof;
using Ranges = std::vector<std::pair<Dof, core::Range>>;

class FixtureOf : public ::testing::Test {
 protected:
  FixtureOf() {
    support::TemporaryFolder folder;
    support::write_full_studio_files(folder.path());
    studio_ = parse_studio(support::full_studio_text(), folder.path(), support::shipped_folders())
                  ->studio;
  }
  const Fixture& fixture(const char* name) const { return *studio_.fixture(name); }
  Studio studio_;
};

TEST_F(FixtureOf, ASoftboxMakesARectangleAndTakesItsStops) {
  const Fixture& key = fixture("key");
  EXPECT_EQ(key.fitted_optic().kind, Optic::Kind::rectangle);
  EXPECT_DOUBLE_EQ(key.fitted_optic().width, 0.6);
  EXPECT_DOUBLE_EQ(key.fitted_optic().height, 0.9);
  EXPECT_NEAR(key.fitted_output().value, 14000 / std::pow(2, 1.3), 1e-9);
}

TEST_F(FixtureOf, BareIsTheProfilesOwnOptic) {
  Fixture key = fixture("key");
  std::swap(key.modifiers[0], key.modifiers[1]);
  EXPECT_EQ(key.fitted_optic(), key.profile.optic);
  EXPECT_DOUBLE_EQ(key.fitted_output().value, 14000);
}

TEST_F(FixtureOf, RangesOfAStandWithTwoChannels) {
  const double deg = core::kPi / 180;
  EXPECT_EQ(fixture("key").ranges(), (Ranges{{Dof::intensity, {0, 0.8}},
                                             {Dof::cct, {2700, 6500}},
                                             {Dof::azimuth, {-80 * deg, 80 * deg}},
                                             {Dof::elevation, {-45 * deg, 70 * deg}},
                                             {Dof::distance, {1.2, 2.4}}}));
}

TEST_F(FixtureOf, OnlyWhatItsModeControls) {
  // 3ch-tint has a tint channel, and the arc its angle.
  EXPECT_EQ(fixture("fill").ranges(),
            (Ranges{{Dof::intensity, {0, 1}},
                    {Dof::cct, {2700, 6500}},
                    {Dof::tint, {-10, 10}},
                    {Dof::arc, {core::radians(-80), core::radians(80)}}}));
  EXPECT_EQ(fixture("hair").ranges(), (Ranges{{Dof::intensity, {0, 1}}, {Dof::track, {0, 1}}}));
  // Without a dimmer channel the drives carry the level.
  EXPECT_EQ(fixture("drive").ranges(), (Ranges{{Dof::intensity, {0, 1}},
                                               {Dof::red, {0, 1}},
                                               {Dof::green, {0, 1}},
                                               {Dof::blue, {0, 1}},
                                               {Dof::white, {0, 1}}}));
  // A head whose mode has no channel for pan and tilt does not turn.
  EXPECT_EQ(fixture("head").ranges().back().first, Dof::blue);
}

TEST(Ranges, OfAHeadAreWhatItsChannelsReachOfWhatItsMountAllows) {
  const Studio studio = support::studio_from(support::studio_text(
      "  a: {role: key, profile: generic/moving-head, mode: 8ch, mount: {pan_tilt: {at: [-1, -1, "
      "3], "
      "aim_at: [0, 0, 1.4], pan: [-400 deg, 90 deg], tilt: [-200 deg, 30 deg], neutral: {pan: 20 "
      "deg, "
      "tilt: 100 deg}, invert_tilt: yes}}, patch: {universe: 1, address: 1}}\n"));
  const auto ranges = studio.fixtures[0].ranges();
  const auto range = [&](Dof dof) {
    for (const auto& [each, its] : ranges)
      if (each == dof) return core::Range{core::degrees(its.least), core::degrees(its.most)};
    return core::Range{0, 0};
  };
  EXPECT_NEAR(range(Dof::pan).least, -290, 1e-9);  // -270 of the head, 20 before
  EXPECT_NEAR(range(Dof::pan).most, 90, 1e-9);     // the mount's
  EXPECT_NEAR(range(Dof::tilt).least, -35, 1e-9);  // 100 - 135
  EXPECT_NEAR(range(Dof::tilt).most, 30, 1e-9);
}

TEST_F(FixtureOf, WhatHandsSetHasTheHandsRange) {
  EXPECT_EQ(fixture("tungsten").ranges(),
            (Ranges{{Dof::intensity, {0, 1}}, {Dof::cct, {3200, 5600}}}));
  EXPECT_EQ(fixture("flash").ranges(), (Ranges{{Dof::intensity, {0, 1}}}));
}

TEST_F(FixtureOf, AnUncontrolledPracticalHasNone) {
  EXPECT_TRUE(fixture("window").ranges().empty());
}

TEST_F(FixtureOf, ThePlacedRigIsTheMountsAndTheFirstLevels) {
  const Rig rig = placed_rig(studio_);
  ASSERT_EQ(rig.states.size(), studio_.fixtures.size());
  const auto& key = rig.states[*studio_.fixture_index("key")];
  EXPECT_DOUBLE_EQ(key.get(Dof::azimuth), core::radians(-45));
  EXPECT_DOUBLE_EQ(key.get(Dof::distance), 1.8);
  EXPECT_DOUBLE_EQ(key.get(Dof::intensity), 0.3);
  const auto& tungsten = rig.states[*studio_.fixture_index("tungsten")];
  EXPECT_FALSE(tungsten.has(Dof::azimuth));
  const auto& head = rig.states[*studio_.fixture_index("head")];
  EXPECT_DOUBLE_EQ(head.get(Dof::pan, -9), 0);
  EXPECT_DOUBLE_EQ(rig.states[*studio_.fixture_index("free")].get(Dof::elevation),
                   core::radians(20));
}

TEST_F(FixtureOf, LookedUpByName) {
  EXPECT_EQ(studio_.fixture("nobody"), nullptr);
  EXPECT_FALSE(studio_.fixture_index("nobody"));
  EXPECT_EQ(studio_.fixtures[*studio_.fixture_index("hair")].name, "hair");
}

TEST(ExposureGain, AGreyCardAtItsIlluminanceIsMidGrey) {
  // 0.18 * 800 lx * gain = Y of L* 50 = ((50 + 16) / 116)^3 = 0.184187
  EXPECT_NEAR(0.18 * 800 * exposure_gain({{800}, {5600}}, {}), 0.184187, 1e-6);
}

TEST(ExposureGain, CameraSettingsWinByTheIncidentMeter) {
  Camera camera;
  camera.shutter_s = 1.0 / 50;
  camera.aperture_f = 2.8;
  camera.iso = 400;
  // E = C N^2 / (t S) = 250 * 7.84 / (0.02 * 400) = 245 lx
  EXPECT_NEAR(0.18 * 245 * exposure_gain({{800}, {5600}}, camera), 0.184187, 1e-6);
  camera.iso.reset();
  EXPECT_NEAR(0.18 * 800 * exposure_gain({{800}, {5600}}, camera), 0.184187, 1e-6);
}

TEST_F(FixtureOf, ColourOfAWhiteLampAtTheBalanceIsExactlyWhite) {
  core::FixtureState state;
  state.set(Dof::cct, 5600);
  EXPECT_EQ(light_colour(fixture("fill"), state, {5600}), (core::Rgb{1, 1, 1}));
  EXPECT_EQ(light_colour(fixture("flash"), {}, {5600}), (core::Rgb{1, 1, 1}));
}

TEST_F(FixtureOf, AWarmLampIsRedderAndAsBright) {
  core::FixtureState state;
  state.set(Dof::cct, 3200);
  const core::Rgb warm = light_colour(fixture("fill"), state, {5600});
  EXPECT_GT(warm.r, 1.2);
  EXPECT_LT(warm.b, 0.6);
  EXPECT_NEAR(core::luminance(warm), 1, 1e-9);
  // A plain lamp has that colour without being asked, unless a gel is on it.
  EXPECT_NEAR(light_colour(fixture("hair"), {}, {5600}).r, warm.r, 1e-12);
  state.set(Dof::cct, 5600);
  EXPECT_EQ(light_colour(fixture("tungsten"), state, {5600}), (core::Rgb{1, 1, 1}));
}

TEST_F(FixtureOf, GreenTintIsGreener) {
  core::FixtureState neutral, green;
  neutral.set(Dof::cct, 5600);
  green = neutral;
  green.set(Dof::tint, 10);
  const core::Rgb a = light_colour(fixture("fill"), neutral, {5600});
  const core::Rgb b = light_colour(fixture("fill"), green, {5600});
  EXPECT_GT(b.g / b.r, a.g / a.r * 1.02);
}

TEST_F(FixtureOf, AMixtureAddsItsDrivesAndAllAtOneIsFullWhite) {
  const Fixture& drive = fixture("drive");
  core::FixtureState all;
  for (const Dof dof : {Dof::red, Dof::green, Dof::blue, Dof::white}) all.set(dof, 1);
  EXPECT_NEAR(core::luminance(light_colour(drive, all, {5600})), 1, 1e-9);
  core::Rgb sum;
  for (const Primary& primary : drive.profile.emitter.primaries) {
    core::FixtureState one;
    for (const Dof dof : {Dof::red, Dof::green, Dof::blue, Dof::white}) one.set(dof, 0);
    one.set(primary.dof, 1);
    const core::Rgb alone = light_colour(drive, one, {5600});
    EXPECT_NEAR(core::luminance(alone), primary.share, 1e-9);
    sum = sum + alone;
  }
  const core::Rgb together = light_colour(drive, all, {5600});
  EXPECT_NEAR(sum.r, together.r, 1e-12);
  EXPECT_NEAR(sum.g, together.g, 1e-12);
  EXPECT_NEAR(sum.b, together.b, 1e-12);
}

TEST(RoleNames, AreTheFilesWords) {
  EXPECT_EQ(name_of(Role::key), "key");
  EXPECT_EQ(name_of(Role::background), "background");
  EXPECT_EQ(name_of(Role::practical), "practical");
}

}  // namespace
}  // namespace chiaro::studio
