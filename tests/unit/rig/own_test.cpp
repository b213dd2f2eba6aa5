// SPDX-License-Identifier: Apache-2.0
// Faders and masters at the hand itself beside the brain's: the newest has the say, and neither a
// restart of the brain nor of the hand changes a level.
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

#include "controller/rig/governor.h"
#include "tests/support/studios.h"

namespace chiaro::rig {
namespace {

using core::Dof;
using namespace std::chrono_literals;

const ports::TimePoint kStart{100s};

class OwnTest : public testing::Test {
 protected:
  OwnTest() {
    studio_ = support::studio_from(
        support::studio_text(support::fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1) +
                             support::fixture_line("b", "generic/daylight-dimmer", "1ch", 1, 2,
                                                   "limits: {most: 80 %}")));
    governor_.emplace(studio_, kStart);
    wanted_.studio_fingerprint = studio_.fingerprint;
    for (auto& source : wanted_.sources) source.fixtures.resize(2);
    wanted_.release_id.resize(2);
  }
  void say(Source source, std::size_t lamp, std::optional<double> level, double fade_s = 0) {
    auto& word = wanted_.sources[static_cast<std::size_t>(source)];
    word.fade_id = ++newest_;
    word.fade_s = fade_s;
    if (level)
      word.fixtures[lamp].set(Dof::intensity, *level);
    else
      word.fixtures[lamp].clear(Dof::intensity);
  }
  void post(ports::Duration at) {
    wanted_.posted_ns = (kStart + at).time_since_epoch().count();
    governor_->take(wanted_, kStart + at);
  }
  void fader(std::size_t lamp, double level, ports::Duration at) {
    governor_->set_level(lamp, Dof::intensity, level, kStart + at);
  }
  double sent(ports::Duration at, std::size_t lamp) {
    return governor_->step(kStart + at).fixtures()[lamp].get(Dof::intensity);
  }
  Sent report() {
    Sent sent = governor_->empty_report();
    governor_->report(sent);
    return sent;
  }
  /// The hand is started again and finds its last levels; the brain goes on as if nothing were.
  void restart_the_hand() {
    const Sent before = report();
    Held held;
    held.fixtures = before.held;
    held.own = before.sources[static_cast<std::size_t>(Source::own)].fixtures;
    held.masters = before.masters;
    held.blackout = before.blackout;
    held.motion_stop = before.motion_stop.on;
    held.fade_id = before.fade_id;
    held.master_id = before.master_id;
    held.blackout_id = before.blackout_id;
    held.stop_id = before.motion_stop.id;
    held.arm_id = before.motion_armed.id;
    governor_.emplace(studio_, kStart, &held);
  }

  studio::Studio studio_;
  std::optional<Governor> governor_;
  Wanted wanted_;
  std::uint64_t newest_ = 0;
};

TEST_F(OwnTest, AFaderAtTheHandStandsAboveTheBrainsUntilThatOneIsMoved) {
  say(Source::look, 0, 0.3);
  say(Source::manual, 0, 0.4);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.4);
  fader(0, 0.9, 1s);
  EXPECT_EQ(sent(1s, 0), 0.9);
  post(1s);  // the brain's heartbeat says nothing new
  EXPECT_EQ(sent(1s, 0), 0.9);
  say(Source::manual, 1, 0.2);  // another lamp's fader
  post(2s);
  EXPECT_EQ(sent(2s, 0), 0.9);
  say(Source::manual, 0, 0.5);
  post(3s);
  EXPECT_EQ(sent(3s, 0), 0.5);
}

TEST_F(OwnTest, ANewLookTakesTheHandsFadersInItsOwnFade) {
  fader(0, 1, 0s);
  EXPECT_EQ(sent(0s, 0), 1);
  say(Source::look, 0, 0, 2);
  post(1s);
  sent(1s, 0);
  EXPECT_NEAR(sent(2s, 0), 0.184, 0.001);  // half-way in lightness
  EXPECT_EQ(sent(3s, 0), 0);
}

TEST_F(OwnTest, ReleasedItFadesBackToWhoeverElseHasAnOpinion) {
  say(Source::look, 0, 0.3);
  post(0s);
  fader(0, 0.9, 0s);
  EXPECT_EQ(sent(0s, 0), 0.9);
  governor_->release(0, kStart + 1s);
  sent(1s, 0);
  const double half_way = sent(1250ms, 0);
  EXPECT_GT(half_way, 0.3);
  EXPECT_LT(half_way, 0.9);
  EXPECT_EQ(sent(1500ms, 0), 0.3);
}

TEST_F(OwnTest, TheBrainMayReleaseWhatTheHandHoldsOncePerId) {
  say(Source::look, 0, 0.3);
  wanted_.release_id[0] = 5;  // from before this hand began: done long ago
  post(0s);
  fader(0, 0.9, 0s);
  post(1s);
  EXPECT_EQ(sent(1s, 0), 0.9);
  wanted_.release_id[0] = 6;
  post(2s);
  sent(2s, 0);
  EXPECT_EQ(sent(3s, 0), 0.3);
  fader(0, 0.8, 4s);
  post(5s);
  EXPECT_EQ(sent(5s, 0), 0.8);
}

TEST_F(OwnTest, ItObeysLimitsMastersAndBlackoutAndPassesOverNonsense) {
  fader(1, 1, 0s);
  EXPECT_EQ(sent(0s, 1), 0.8);
  governor_->set_master(Master::grand, 0.5);
  EXPECT_DOUBLE_EQ(sent(0s, 1), 0.4);
  fader(1, std::nan(""), 0s);
  governor_->set_level(0, Dof::pan, 1, kStart);
  governor_->set_level(99, Dof::intensity, 1, kStart);
  governor_->set_master(Master::grand, std::nan(""));
  EXPECT_DOUBLE_EQ(sent(0s, 1), 0.4);
  governor_->set_blackout(true);
  EXPECT_EQ(sent(1s, 1), 0);
}

TEST_F(OwnTest, TheNewestOfBothSidesMovesAMaster) {
  say(Source::look, 0, 1);
  wanted_.masters[0] = 0.8;
  wanted_.master_id[0] = 1;
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.8);
  governor_->set_master(Master::grand, 0.4);
  post(1s);
  EXPECT_EQ(sent(1s, 0), 0.4);
  EXPECT_EQ(report().masters[0], 0.4);
  wanted_.master_id[0] = 2;  // the same value, said anew
  post(2s);
  EXPECT_EQ(sent(2s, 0), 0.8);
  EXPECT_EQ(report().master_id[0], 2u);
}

TEST_F(OwnTest, ARestartOfTheHandUndoesNothingThatWasDoneAtIt) {
  say(Source::look, 0, 0.3);
  wanted_.masters[0] = 0.8;
  wanted_.master_id[0] = 7;
  wanted_.blackout_id = 8;  // was on and is off again
  wanted_.motion_stop = {false, 9};
  post(0s);
  sent(0s, 0);
  fader(0, 0.9, 0s);
  governor_->set_master(Master::grand, 0.5);
  governor_->stop_motion(true);
  const double before = sent(1s, 0);
  restart_the_hand();
  EXPECT_EQ(sent(0s, 0), before);
  post(1s);
  EXPECT_EQ(sent(1s, 0), before);
  EXPECT_TRUE(report().motion_stop.on);
  governor_->set_blackout(true);
  sent(1s, 0);
  restart_the_hand();
  post(2s);
  EXPECT_EQ(sent(2s, 0), 0);
}

TEST_F(OwnTest, BlindAtTheHandHoldsTheBrainsWordBackUntilItEnds) {
  say(Source::look, 0, 0.3);
  post(0s);
  sent(0s, 0);
  governor_->set_blind(true);
  say(Source::look, 0, 0.9, 1);
  post(1s);
  EXPECT_EQ(sent(1s, 0), 0.3);
  EXPECT_TRUE(report().blind);
  governor_->set_blind(false);
  post(2s);
  sent(2s, 0);
  EXPECT_EQ(sent(3s, 0), 0.9);
}

}  // namespace
}  // namespace chiaro::rig
