// SPDX-License-Identifier: Apache-2.0
#include "controller/rig/governor.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>

#include "controller/core/colour.h"
#include "tests/support/studios.h"

namespace chiaro::rig {
namespace {

using core::Dof;
using core::FixtureState;
using namespace std::chrono_literals;
using support::fixture_line;

const ports::TimePoint kStart{100s};
constexpr double kHalfWay = 0.18418651851244416;  // Y of L* 50

FixtureState level(double intensity) {
  FixtureState state;
  state.set(Dof::intensity, intensity);
  return state;
}

/// A studio of two dimmers and a brain that speaks to its governor.
class GovernorTest : public testing::Test {
 protected:
  void build(const std::string& more = "", const std::string& first = "",
             const std::string& second = "", const Held* held = nullptr) {
    studio_ = support::studio_from(
        support::studio_text(fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1, first) +
                                 fixture_line("b", "generic/daylight-dimmer", "1ch", 1, 2, second),
                             more));
    governor_.emplace(studio_, kStart, held);
    wanted_.studio_fingerprint = studio_.fingerprint;
    for (auto& source : wanted_.sources) source.fixtures.resize(2);
  }
  SourceState& source(Source s) { return wanted_.sources[static_cast<std::size_t>(s)]; }
  /// One source's word on the first lamp.
  void say(Source s, std::optional<double> intensity, std::uint64_t fade_id, double fade_s) {
    source(s).fixtures[0] = intensity ? level(*intensity) : FixtureState{};
    source(s).fade_id = fade_id;
    source(s).fade_s = fade_s;
  }
  void post(ports::Duration at) {
    wanted_.posted_ns = (kStart + at).time_since_epoch().count();
    governor_->take(wanted_, kStart + at);
  }
  double sent(ports::Duration at, std::size_t lamp = 0) {
    return governor_->step(kStart + at).fixtures()[lamp].get(Dof::intensity);
  }

  studio::Studio studio_;
  std::optional<Governor> governor_;
  Wanted wanted_;
};

TEST_F(GovernorTest, FadesAsAFunctionOfTimeHoweverLateTheTicks) {
  build();
  say(Source::look, 1, 1, 2);
  post(0s);
  EXPECT_EQ(sent(0s), 0);
  EXPECT_NEAR(sent(1s), kHalfWay, 1e-12);  // a whole second late, and exactly there
  EXPECT_EQ(sent(2s), 1);
}

TEST_F(GovernorTest, DoesNotRestartAFadeWhoseIdItHasSeen) {
  build();
  say(Source::look, 1, 1, 2);
  for (auto t = 0ms; t <= 1000ms; t += 250ms) post(t), sent(t);
  EXPECT_NEAR(sent(1s), kHalfWay, 1e-12);
}

TEST_F(GovernorTest, StartsANewFadeFromWhatIsBeingSent) {
  build();
  say(Source::look, 1, 1, 2);
  post(0s);
  sent(1s);
  say(Source::look, 0, 2, 1);
  post(1s);
  EXPECT_NEAR(sent(1s), kHalfWay, 1e-12);
  EXPECT_NEAR(sent(1500ms), core::luminance_of_lightness(25), 1e-9);
  EXPECT_EQ(sent(2s), 0);
}

TEST_F(GovernorTest, EndsAFadeThoughTheBrainDiesHalfWay) {
  build();
  say(Source::look, 1, 1, 10);
  post(0s);
  EXPECT_EQ(sent(10s), 1);
  EXPECT_EQ(governor_->caution(), Caution::hold);
}

TEST_F(GovernorTest, PutsManualOverLookOverAutomaticOverTheStudioFile) {
  build("", "initial: {intensity: 10 %}");
  EXPECT_EQ(sent(0s), 0.1);
  say(Source::automatic, 0.2, 1, 0);
  post(0s);
  EXPECT_EQ(sent(25ms), 0.2);
  say(Source::look, 0.3, 1, 0);
  post(25ms);
  EXPECT_EQ(sent(50ms), 0.3);
  say(Source::manual, 0.4, 1, 0);
  post(50ms);
  EXPECT_EQ(sent(75ms), 0.4);
  say(Source::look, 0.9, 2, 0);
  post(75ms);
  EXPECT_EQ(sent(100ms), 0.4);
  EXPECT_EQ(sent(100ms, 1), 0);
}

TEST_F(GovernorTest, FadesBackToTheLookWhenAFaderLetsGo) {
  build();
  say(Source::look, 1, 1, 0);
  say(Source::manual, 0.5, 1, 0);
  post(0s);
  sent(0s);
  say(Source::manual, std::nullopt, 2, 2);
  post(0s);
  EXPECT_EQ(sent(0s), 0.5);
  EXPECT_GT(sent(1s), 0.5);
  EXPECT_LT(sent(1s), 1);
  EXPECT_EQ(sent(2s), 1);
}

TEST_F(GovernorTest, FollowsAMovingTargetToTheEndOfTheRunningFade) {
  build();
  say(Source::look, 1, 1, 2);
  post(0s);
  const double half = sent(1s);
  say(Source::look, 0.5, 1, 2);
  post(1s);
  EXPECT_EQ(sent(1s), half);  // no jump
  EXPECT_EQ(sent(2s), 0.5);   // and the end is where it was
}

TEST_F(GovernorTest, MultipliesByGrandAndRoleMaster) {
  build();
  say(Source::look, 0.8, 1, 0);
  wanted_.masters = {0.5, 0.5, 1, 1, 1};
  post(0s);
  EXPECT_DOUBLE_EQ(sent(0s), 0.2);
}

TEST_F(GovernorTest, NeverExceedsTheLimitWhoeverAsks) {
  build("", "limits: {most: 60 %}");
  say(Source::manual, 1, 1, 0);
  post(0s);
  EXPECT_EQ(sent(0s), 0.6);
  say(Source::manual, 1e9, 1, 0);
  post(0s);
  EXPECT_EQ(sent(25ms), 0.6);
}

TEST_F(GovernorTest, TreatsWhatIsNoNumberAsAbsent) {
  build("", "initial: {intensity: 30 %}");
  say(Source::manual, std::nan(""), 1, 0);
  wanted_.masters[0] = std::numeric_limits<double>::quiet_NaN();
  post(0s);
  EXPECT_EQ(sent(0s), 0.3);
  say(Source::manual, std::numeric_limits<double>::infinity(), 1, 0);
  post(0s);
  EXPECT_EQ(sent(25ms), 0.3);
}

TEST_F(GovernorTest, LimitsTheSlewAndStartsTheNextFadeFromWhatIsSent) {
  build("", "limits: {dark_to_full: 2 s}");
  sent(0s);
  say(Source::look, 1, 1, 0);
  post(0s);
  EXPECT_DOUBLE_EQ(sent(500ms), 0.25);
  EXPECT_DOUBLE_EQ(sent(1s), 0.5);
  say(Source::look, 0.5, 2, 10);
  post(1s);
  EXPECT_DOUBLE_EQ(sent(1500ms), 0.5);
}

TEST_F(GovernorTest, DarkensAtOnceOnBlackoutButForLampsThatIgnoreIt) {
  build("", "initial: {intensity: 70 %}", "initial: {intensity: 40 %}, limits: {house_light: yes}");
  sent(0s);
  governor_->set_blackout(true);
  EXPECT_EQ(sent(25ms), 0);
  EXPECT_EQ(sent(25ms, 1), 0.4);
  EXPECT_EQ(governor_->caution(), Caution::blackout);
  post(50ms);  // a brain that has not heard of it does not release it
  EXPECT_EQ(sent(50ms), 0);
  governor_->set_blackout(false);
  EXPECT_EQ(sent(75ms), 0.7);
}

TEST_F(GovernorTest, TakesABrainsBlackoutWishOncePerIdEvenFromAnotherStudio) {
  build("", "initial: {intensity: 70 %}");
  wanted_.studio_fingerprint ^= 1;
  wanted_.blackout = true;
  wanted_.blackout_id = 1;
  post(0s);
  EXPECT_EQ(sent(0s), 0);
  governor_->set_blackout(false);
  post(25ms);
  EXPECT_EQ(sent(25ms), 0.7);
}

TEST_F(GovernorTest, HoldsAndSaysSoWhenTheFingerprintsDiffer) {
  build();
  say(Source::look, 0.5, 1, 0);
  post(0s);
  sent(0s);
  wanted_.studio_fingerprint ^= 1;
  say(Source::look, 0.9, 2, 0);
  post(25ms);
  EXPECT_EQ(sent(25ms), 0.5);
  EXPECT_EQ(governor_->caution(), Caution::hold);
  Sent report = governor_->empty_report();
  governor_->report(report);
  EXPECT_TRUE(report.refused);
}

TEST_F(GovernorTest, HoldsForEverWhenTheBrainFallsSilent) {
  build();
  say(Source::look, 0.5, 1, 0);
  post(0s);
  sent(0s);
  EXPECT_EQ(governor_->caution(), Caution::normal);
  EXPECT_EQ(sent(1001ms), 0.5);
  EXPECT_EQ(governor_->caution(), Caution::hold);
  EXPECT_EQ(sent(24h), 0.5);
  EXPECT_EQ(governor_->caution(), Caution::hold);
}

TEST_F(GovernorTest, FadesToEachLampsSafeLevelWhenTheStudioSaysSoAndBackAsGently) {
  build("safety: {when_silent: {fade_to_safe: {after: 10 s, over: 2 s}}}\n", "",
        "limits: {safe_level: 30 %}");
  say(Source::look, 1, 1, 0);
  post(0s);
  sent(0s);
  EXPECT_EQ(sent(9s), 1);
  for (auto t = 9000ms; t <= 12100ms; t += 25ms) sent(t);
  EXPECT_EQ(sent(12100ms), 0);
  EXPECT_EQ(sent(12100ms, 1), 0.3);
  EXPECT_EQ(governor_->caution(), Caution::fade_to_safe);
  post(12100ms);
  EXPECT_LT(sent(12125ms), 0.01);  // no jump because a program came back
  for (auto t = 12125ms; t <= 14200ms; t += 25ms) post(t), sent(t);
  EXPECT_EQ(sent(14200ms), 1);
  EXPECT_EQ(governor_->caution(), Caution::normal);
}

TEST_F(GovernorTest, ComesUpAtTheHeldLevelsWithMastersAndBlackout) {
  Held held;
  held.fixtures = {level(0.4), level(0.8)};
  held.masters = {0.5, 1, 1, 1, 1};
  build("", "", "", &held);
  EXPECT_EQ(sent(0s), 0.2);
  held.blackout = true;
  governor_.emplace(studio_, kStart, &held);
  EXPECT_EQ(sent(0s), 0);
  governor_->set_blackout(false);
  EXPECT_EQ(sent(25ms), 0.2);
}

TEST_F(GovernorTest, ComesUpDarkWhenTheStudioSaysSo) {
  Held held;
  held.fixtures = {level(0.4), level(0.8)};
  build("safety: {power_up: dark}\n", "initial: {intensity: 50 %}", "", &held);
  EXPECT_EQ(sent(0s), 0);
}

TEST_F(GovernorTest, DoesNotFlashBecauseAProgramWantsIt) {
  build();
  int high = 0;
  double before = 0;
  for (int i = 0; i < 40; ++i) {  // 20 flashes in one second
    say(Source::automatic, i % 2, static_cast<std::uint64_t>(i), 0);
    post(i * 25ms);
    const double now = sent(i * 25ms);
    if (now - before >= 0.1) ++high;
    before = now;
  }
  EXPECT_EQ(high, 3);
}

TEST_F(GovernorTest, GoesOnMidFadeUnderAnotherStudioFile) {
  build();
  say(Source::look, 1, 1, 2);
  post(0s);
  sent(500ms);
  const studio::Studio changed = support::studio_from(
      support::studio_text(fixture_line("c", "generic/dimmer", "1ch", 1, 9) +
                           fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1)));
  Governor next(changed, kStart + 500ms);
  const std::ptrdiff_t from[] = {-1, 0};
  next.carry_on(*governor_, from);
  EXPECT_NEAR(next.step(kStart + 1s).fixtures()[1].get(Dof::intensity), kHalfWay, 1e-12);
  EXPECT_EQ(next.caution(), Caution::hold);  // until the brain speaks of the new studio
  Wanted again = wanted_;
  again.studio_fingerprint = changed.fingerprint;
  again.posted_ns = (kStart + 1s).time_since_epoch().count();
  for (auto& source : again.sources) std::swap(source.fixtures[0], source.fixtures[1]);
  next.take(again, kStart + 1s);
  EXPECT_EQ(next.step(kStart + 2s).fixtures()[1].get(Dof::intensity), 1);
  EXPECT_EQ(next.caution(), Caution::normal);
}

TEST_F(GovernorTest, IgnoresAWordFromBeforeAReboot) {
  build();
  say(Source::look, 1, 1, 0);
  wanted_.posted_ns = (kStart + 1h).time_since_epoch().count();
  governor_->take(wanted_, kStart);
  EXPECT_EQ(sent(0s), 0);
}

}  // namespace
}  // namespace chiaro::rig
