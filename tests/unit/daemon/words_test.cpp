// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/words.h"

#include <gtest/gtest.h>

#include "controller/daemon/brain/placements.h"

namespace chiaro::daemon {
namespace {

using core::Dof;

TEST(LevelInWords, IsPerCentAndStopsBelowFull) {
  EXPECT_EQ(level_in_words(0), "off");
  EXPECT_EQ(level_in_words(1), "full");
  EXPECT_EQ(level_in_words(0.62), "62 %, 0.7 stops below full");
  EXPECT_EQ(level_in_words(0.5), "50 %, 1.0 stop below full");
  EXPECT_EQ(level_in_words(0.031), "3.1 %, 5.0 stops below full");
}

TEST(ColourInWords, IsKelvinForWhiteAndDrivesForColours) {
  studio::Fixture fixture;
  core::FixtureState state;
  EXPECT_EQ(colour_in_words(fixture, state), "");
  fixture.profile.emitter.kind = studio::Emitter::Kind::bicolour;
  state.set(Dof::cct, 4304);
  EXPECT_EQ(colour_in_words(fixture, state), "4300 K");
  state.set(Dof::tint, -8);
  EXPECT_EQ(colour_in_words(fixture, state), "4300 K, 8 towards magenta");
  fixture.profile.emitter.kind = studio::Emitter::Kind::mixed;
  fixture.profile.emitter.primaries = {{Dof::red, {}, 1}, {Dof::warm_white, {}, 1}};
  state.set(Dof::red, 0.8);
  EXPECT_EQ(colour_in_words(fixture, state), "red 80 %");
}

TEST(RatioInWords, IsShortEnoughToBeSaid) {
  EXPECT_EQ(ratio_in_words(4), "4:1");
  EXPECT_EQ(ratio_in_words(2.83), "2.8:1");
  EXPECT_EQ(ratio_in_words(15.7), "16:1");
}

core::FixtureState place(double azimuth_deg, double distance) {
  core::FixtureState state;
  state.set(Dof::azimuth, core::radians(azimuth_deg));
  state.set(Dof::elevation, 0);
  state.set(Dof::distance, distance);
  return state;
}

TEST(StandsThere, WithinADegreeAndThreeCentimetres) {
  EXPECT_TRUE(stands_there(place(10, 2), place(10.9, 2.02)));
  EXPECT_FALSE(stands_there(place(10, 2), place(11.2, 2)));
  EXPECT_FALSE(stands_there(place(10, 2), place(10, 2.05)));
  EXPECT_TRUE(stands_there(place(179.8, 2), place(-179.9, 2))) << "the short way round";
}

studio::Studio one_stand(double azimuth_deg) {
  studio::Studio studio;
  studio.name = "s";
  studio.fixtures.resize(1);
  studio.fixtures[0].name = "key";
  studio::StandMount stand;
  stand.at = {core::radians(azimuth_deg), 0.3, 1.8};
  studio.fixtures[0].mount = stand;
  return studio;
}

TEST(Placements, RememberWhereAStandWasPut) {
  const auto studio = one_stand(-45);
  Placements placements(studio, "");
  placements.move(0, place(-20, 1.5));
  placements.lock(0, true);
  const Placements again(studio, placements.to_json(studio));
  EXPECT_EQ(again.at(0), placements.at(0));
  EXPECT_TRUE(again.locked(0));
  const auto placed = again.placed_studio(studio);
  EXPECT_NEAR(std::get<studio::StandMount>(placed.fixtures[0].mount).at.distance, 1.5, 1e-12);
}

TEST(Placements, FollowTheFileWhereItWasChangedSince) {
  const auto before = one_stand(-45);
  Placements placements(before, "");
  placements.move(0, place(-20, 1.5));
  const auto after = one_stand(-60);
  EXPECT_NEAR(Placements(after, placements.to_json(before)).at(0).get(Dof::azimuth),
              core::radians(-60), 1e-12);
}

TEST(Placements, TakeRubbishForNothing) {
  const auto studio = one_stand(-45);
  for (const char* rubbish : {"", "[", "[]", "{\"key\":3}", "{\"key\":{\"at\":[1]}}"})
    EXPECT_NEAR(Placements(studio, rubbish).at(0).get(Dof::azimuth), core::radians(-45), 1e-12);
}

}  // namespace
}  // namespace chiaro::daemon
