// SPDX-License-Identifier: Apache-2.0
#include "controller/design/nudge.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/design/words.h"
#include "tests/support/analytic_layers.h"

namespace chiaro::design {
namespace {

using core::Dof;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

studio::Fixture with_whites(studio::Fixture fixture) {
  fixture.profile.emitter.kind = studio::Emitter::Kind::bicolour;
  fixture.profile.emitter.cct_range = {2700, 6500};
  fixture.by_hand.push_back({Dof::cct, studio::HandKind::knob, core::Range{2700, 6500}});
  return fixture;
}

/// Key left, fill right, a back light that cannot change its colour.
struct Nudging : ::testing::Test {
  Nudging() : studio(support::analytic_studio()), twin(studio) {
    studio.fixtures = {
        with_whites(support::stand_lamp("key", studio::Role::key,
                                        {core::radians(-45), core::radians(35), 1.8}, 12000)),
        with_whites(support::stand_lamp("fill", studio::Role::fill,
                                        {core::radians(40), core::radians(10), 2.0}, 12000)),
        support::fixed_lamp("back", studio::Role::back, {-0.8, 1.1, 2.3}, 3000)};
    look.name = "start";
    look.goal = "by hand";
    look.placed = studio::placed_rig(studio);
    set(0.2, 0.05, 0.1);
  }
  void set(double key, double fill, double back) {
    const double levels[] = {key, fill, back};
    for (std::size_t i = 0; i < 3; ++i) {
      look.placed.states[i].set(Dof::intensity, levels[i]);
      if (i < 2) look.placed.states[i].set(Dof::cct, 5000);
    }
    look.wanted = look.placed;
  }
  Nudged done(const Nudge& nudge, const NudgeOptions& options = {}) {
    const auto result = nudged(studio, twin, look, nudge, options);
    EXPECT_TRUE(result) << core::to_string(result.problems());
    return result ? *result : Nudged{};
  }
  static double level(const Nudged& after, std::size_t lamp) {
    return after.look.placed.states[lamp].get(Dof::intensity);
  }
  studio::Studio studio;
  support::AnalyticSource twin;
  Look look;
};

TEST_F(Nudging, BrighterByHalfAStopRaisesEveryLampByHalfAStop) {
  const Nudged after = done({.brightness = 2});
  EXPECT_NEAR(level(after, 0), 0.2 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(level(after, 1), 0.05 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(level(after, 2), 0.1 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(after.done.brightness, 2, 0.02);
  EXPECT_EQ(after.look.judgement.verdict, Verdict::reached);
  EXPECT_TRUE(after.by_hand.empty());
  EXPECT_EQ(after.look.goal, "by hand, 0.5 stop brighter");
}

TEST_F(Nudging, ThereAndBackAgainIsWhereItBegan) {
  for (const Nudge there : {Nudge{.brightness = 1}, Nudge{.warmth = 2}, Nudge{.contrast = 1}}) {
    const Look start = look;
    look = done(there).look;
    EXPECT_FALSE(look.placed == start.placed);
    const Nudged back = done({-there.brightness, -there.warmth, -there.contrast, 0});
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(std::log2(level(back, i) / start.placed.states[i].get(Dof::intensity)), 0, 0.05);
      EXPECT_NEAR(back.look.placed.states[i].get(Dof::cct), start.placed.states[i].get(Dof::cct),
                  1);
    }
    look = start;
  }
}

TEST_F(Nudging, NoLampGoesOverItsLimitAndThePersonIsToldWhatWouldHelp) {
  set(0.9, 0.2, 0.1);
  studio.fixtures[0].limits.most = 0.95;
  const Nudged after = done({.brightness = 4});
  EXPECT_LE(level(after, 0), 0.95 + 1e-9);
  EXPECT_EQ(after.look.judgement.limiting_fixture, "key");
  EXPECT_GT(after.look.judgement.missing_stops, 0.5);
  EXPECT_NE(after.look.judgement.verdict, Verdict::reached);
  ASSERT_FALSE(after.by_hand.empty());
  EXPECT_THAT(after.by_hand[0], AllOf(HasSubstr("key is at full"), HasSubstr("bring it to"),
                                      HasSubstr("open the camera")));
  EXPECT_EQ(after.look.instructions[0], after.by_hand[0]);
}

TEST_F(Nudging, ALockedLampStaysAndTheOthersDoWhatTheyCan) {
  const Nudged after = done({.brightness = 2, .warmth = 2}, {.locked = {"fill"}});
  EXPECT_EQ(after.look.placed.states[1], look.placed.states[1]);
  EXPECT_GT(level(after, 0), 0.2);
  EXPECT_LT(after.look.placed.states[0].get(Dof::cct), 5000);
}

TEST_F(Nudging, MoreContrastOpensTheRatioAndKeepsTheLight) {
  const double before = *key_fill_ratio(studio, look.placed);
  const Nudged more = done({.contrast = 1});
  EXPECT_NEAR(more.done.contrast, 1, 0.15);
  EXPECT_NEAR(more.done.brightness, 0, 0.5);
  EXPECT_GT(*key_fill_ratio(studio, more.look.placed), before * 1.05);
  const Nudged less = done({.contrast = -1});
  EXPECT_LT(*key_fill_ratio(studio, less.look.placed), before / 1.05);
  EXPECT_NEAR(less.done.contrast, -1, 0.15);
}

TEST_F(Nudging, WithNothingToLightTheShadowsLessContrastIsForAPerson) {
  set(0.2, 0, 0);
  const Nudged after = done({.contrast = -2}, {.locked = {"fill", "back"}});
  EXPECT_EQ(after.look.judgement.verdict, Verdict::not_reachable);
  ASSERT_FALSE(after.by_hand.empty());
  EXPECT_THAT(after.by_hand[0], HasSubstr("reflector"));
}

TEST_F(Nudging, WarmerShiftsLampsByTheSameMiredsAndNamesTheOneThatCannot) {
  studio.fixtures[2] = support::fixed_lamp("back", studio::Role::back, {0.3, -1.6, 2.2}, 3000);
  set(0.05, 0.05, 0.5);
  const Nudged after = done({.warmth = 2});
  for (const std::size_t lamp : {0u, 1u})
    EXPECT_NEAR(1e6 / after.look.placed.states[lamp].get(Dof::cct), 1e6 / 5000 + 40, 0.01);
  EXPECT_FALSE(after.look.placed.states[2].has(Dof::cct) &&
               after.look.placed.states[2].get(Dof::cct) != look.placed.states[2].get(Dof::cct));
  EXPECT_LT(after.done.warmth, 1.9);
  ASSERT_FALSE(after.by_hand.empty());
  EXPECT_THAT(after.by_hand[0],
              AllOf(HasSubstr("back"), HasSubstr("40 mired"), HasSubstr("white balance")));
}

TEST_F(Nudging, ColourStopsAtTheLampsEnd) {
  for (auto& state : look.placed.states) state.set(Dof::cct, 2750);
  look.wanted = look.placed;
  const Nudged after = done({.warmth = 4});
  EXPECT_NEAR(after.look.placed.states[0].get(Dof::cct), 2700, 1e-6);
  EXPECT_EQ(after.look.judgement.verdict, Verdict::not_reachable);
}

TEST_F(Nudging, SofterIsAnInstructionThatNamesTheSoftbox) {
  studio.fixtures[0].profile.optic.kind = studio::Optic::Kind::rectangle;
  studio.fixtures[0].profile.optic.width = studio.fixtures[0].profile.optic.height = 0.3;
  studio.fixtures[0].modifiers = {{"bare", 0, 0, 0}, {"softbox", 0.6, 0.9, 1.3}};
  const Nudged softer = done({.softness = 1});
  EXPECT_EQ(softer.look.placed, look.placed);
  ASSERT_EQ(softer.by_hand.size(), 1u);
  EXPECT_EQ(softer.by_hand[0],
            "softer: fit the softbox to key: seen from the face it is then 23° wide instead of "
            "10°, with 1⅓ stops less light; or bring key nearer, from 1.8 to 1.51 m");
  std::swap(studio.fixtures[0].modifiers[0], studio.fixtures[0].modifiers[1]);
  EXPECT_THAT(done({.softness = -1}).by_hand[0], HasSubstr("harder: take the softbox off key"));
}

TEST_F(Nudging, StandsThatHaveNotMovedYetGetTheirOwnLevels) {
  look.wanted.states[0].set(Dof::distance, 1.2);
  look.wanted.states[0].set(Dof::intensity, 0.09);
  const Nudged after = done({.brightness = 2});
  EXPECT_NEAR(after.look.wanted.states[0].get(Dof::intensity), 0.09 * std::sqrt(2.0), 1e-3);
  EXPECT_EQ(after.look.wanted.states[0].get(Dof::distance), 1.2);
  EXPECT_EQ(after.look.placed.states[0].get(Dof::distance), 1.8);
}

TEST_F(Nudging, WhatCannotBeNudgedIsAProblemInWords) {
  const auto complaint = [&](const Nudge& nudge, const NudgeOptions& options = {}) {
    const auto result = nudged(studio, twin, look, nudge, options);
    return result ? std::string() : core::to_string(result.problems());
  };
  EXPECT_THAT(complaint({.brightness = 1}, {.locked = {"fil"}}),
              HasSubstr("did you mean \"fill\""));
  EXPECT_THAT(complaint({.brightness = 1}, {.locked = {"key", "fill", "back"}}),
              HasSubstr("every lamp is locked"));
  EXPECT_THAT(complaint({.brightness = 99}), HasSubstr("at most 16 steps"));
  EXPECT_THAT(complaint({.brightness = std::nan("")}), HasSubstr("at most 16 steps"));
  set(0, 0, 0);
  EXPECT_THAT(complaint({.brightness = 1}), HasSubstr("every lamp is dark"));
  look.placed.states.pop_back();
  EXPECT_THAT(complaint({.brightness = 1}), HasSubstr("choose a look of this studio"));
}

TEST(NudgeWords, AreReadAsPeopleSayThem) {
  const auto read = [](const char* text) {
    const auto nudge = nudge_from_words(text);
    EXPECT_TRUE(nudge) << text << ": " << core::to_string(nudge.problems());
    return nudge ? *nudge : Nudge{};
  };
  EXPECT_EQ(read("a little warmer, more dramatic"),
            (Nudge{.brightness = -1, .warmth = 1, .contrast = 2}));
  EXPECT_EQ(read("brighter"), Nudge{.brightness = 2});
  EXPECT_EQ(read("Much darker and slightly softer"), (Nudge{.brightness = -4, .softness = 1}));
  EXPECT_EQ(read("less contrast"), Nudge{.contrast = -2});
  EXPECT_EQ(read("not so warm"), Nudge{.warmth = -2});
  EXPECT_EQ(read("a bit less hard"), Nudge{.softness = 1});
}

TEST(NudgeWords, WhatIsNotUnderstoodIsNamedWithTheNearestWord) {
  const auto complaint = [](const char* text) {
    const auto nudge = nudge_from_words(text);
    return nudge ? std::string() : core::to_string(nudge.problems());
  };
  EXPECT_THAT(complaint("a little wamer"), HasSubstr("did you mean \"warmer\""));
  EXPECT_THAT(complaint("warmer, purpel"), HasSubstr("purpel"));
  EXPECT_THAT(complaint(" , "), HasSubstr("no wish"));
  EXPECT_THAT(complaint("a little"), HasSubstr("does not say what to change"));
}

TEST(NudgeWords, SayBackWhatWasAsked) {
  EXPECT_EQ(nudge_in_words({.brightness = 1, .warmth = -2, .contrast = 6}),
            "0.25 stop brighter, 40 mired cooler, 1.5 stops more contrast");
  EXPECT_EQ(nudge_in_words({}), "as it is");
}

}  // namespace
}  // namespace chiaro::design
