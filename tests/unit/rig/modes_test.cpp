// SPDX-License-Identifier: Apache-2.0
// What a person may do to lamps, each mode by its place in the source stack.
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

#include "controller/rig/governor.h"
#include "controller/rig/keep_out.h"
#include "tests/support/studios.h"

namespace chiaro::rig {
namespace {

using core::Dof;
using core::FixtureState;
using namespace std::chrono_literals;
using support::fixture_line;

const ports::TimePoint kStart{100s};

/// Two coloured lamps, "a" the key and "b" a house light, and a moving head "h".
class ModesTest : public testing::Test {
 protected:
  void build(const std::string& more = "", const std::string& a = "", const Held* held = nullptr) {
    const std::string head =
        "  h: {role: back, profile: generic/rgb, mode: 4ch-dimmer, mount: {pan_tilt: {at: [0, 1, "
        "3], "
        "aim_at: [0, 0, 1], pan: [-180 deg, 180 deg], tilt: [-90 deg, 90 deg]}}, "
        "limits: {end_to_end: 10 s}, patch: {universe: 2, address: 1}}\n";
    studio_ = support::studio_from(support::studio_text(
        fixture_line("a", "generic/rgb", "4ch-dimmer", 1, 1, a) +
            fixture_line("b", "generic/rgb", "4ch-dimmer", 1, 11, "limits: {house_light: yes}") +
            head,
        more));
    for (const Dof axis : {Dof::pan, Dof::tilt}) motorise(studio_.fixtures[2], axis);
    governor_.emplace(studio_, kStart, held);
    wanted_.studio_fingerprint = studio_.fingerprint;
    for (auto& source : wanted_.sources) source.fixtures.resize(3);
    wanted_.marks.resize(3);
  }
  static void motorise(studio::Fixture& lamp, Dof axis) {
    auto& mode = lamp.profile.modes[lamp.mode];
    studio::Channel channel;
    channel.name = core::info(axis).name;
    channel.dof = axis;
    channel.offset = mode.footprint++;
    channel.segments.emplace_back();
    channel.segments.back().physical_from = -core::kPi;
    channel.segments.back().physical_to = core::kPi;
    mode.channels.push_back(channel);
  }
  FixtureState& look(std::size_t lamp) {
    return wanted_.sources[static_cast<std::size_t>(Source::look)].fixtures[lamp];
  }
  /// A look of all three lamps at that level, half red.
  void want(double level, double fade_s = 0) {
    auto& source = wanted_.sources[static_cast<std::size_t>(Source::look)];
    ++source.fade_id;
    source.fade_s = fade_s;
    for (std::size_t i = 0; i < 3; ++i) {
      look(i).set(Dof::intensity, level);
      look(i).set(Dof::red, 0.5);
    }
  }
  void post(ports::Duration at) {
    wanted_.posted_ns = (kStart + at).time_since_epoch().count();
    governor_->take(wanted_, kStart + at);
  }
  double sent(ports::Duration at, std::size_t lamp, Dof dof = Dof::intensity) {
    return governor_->step(kStart + at).fixtures()[lamp].get(dof);
  }
  Sent report() {
    Sent sent = governor_->empty_report();
    governor_->report(sent);
    return sent;
  }
  void mark(std::size_t lamp, Mark which, bool on, ports::Duration at = 0s) {
    governor_->mark(lamp, which, on, kStart + at);
  }
  /// Steps at 40 Hz up to and including `to`, with a heartbeat.
  void run(ports::Duration from, ports::Duration to) {
    for (ports::Duration at = from; at <= to; at += 25ms) {
      if (at % 250ms == 0s) post(at);
      governor_->step(kStart + at);
    }
  }

  studio::Studio studio_;
  std::optional<Governor> governor_;
  Wanted wanted_;
};

TEST_F(ModesTest, HighlightIsFullAndOpenWhiteAboveTheMastersAndLeavesTheOthersAlone) {
  build("", "limits: {most: 80 %}");
  want(0.3);
  wanted_.masters[0] = 0.5;
  wanted_.marks[0] = static_cast<Marks>(Mark::highlight);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.8);  // never past the lamp's own limit
  EXPECT_EQ(sent(0s, 0, Dof::red), 1);
  EXPECT_DOUBLE_EQ(sent(0s, 1), 0.15);
  EXPECT_EQ(sent(0s, 1, Dof::red), 0.5);
  wanted_.marks[0] = 0;
  post(100ms);
  EXPECT_DOUBLE_EQ(sent(100ms, 0), 0.15);
  EXPECT_EQ(sent(100ms, 0, Dof::red), 0.5);
}

TEST_F(ModesTest, FlashIsFullInTheLampsOwnColourUnderTheMasters) {
  build();
  want(0.1);
  wanted_.masters[0] = 0.5;
  post(0s);
  mark(0, Mark::flash, true);
  EXPECT_DOUBLE_EQ(sent(0s, 0), 0.5);
  EXPECT_EQ(sent(0s, 0, Dof::red), 0.5);
  mark(0, Mark::flash, false, 50ms);
  EXPECT_DOUBLE_EQ(sent(50ms, 0), 0.05);
}

TEST_F(ModesTest, FlashFallsByItselfWhenNobodyHoldsItAnyLonger) {
  build();
  want(0.1);
  wanted_.marks[0] = static_cast<Marks>(Mark::flash);
  post(0s);
  mark(1, Mark::flash, true);
  EXPECT_EQ(sent(900ms, 0), 1);
  EXPECT_EQ(sent(900ms, 1), 1);
  EXPECT_EQ(sent(1100ms, 0), 0.1);  // its brain is silent
  EXPECT_EQ(sent(1100ms, 1), 1);
  EXPECT_EQ(sent(kFlashLease, 1), 0.1);
}

TEST_F(ModesTest, SoloDarkensEveryLampWithoutItButHouseLights) {
  build();
  want(0.6);
  post(0s);
  mark(2, Mark::solo, true);
  EXPECT_EQ(sent(0s, 0), 0);
  EXPECT_EQ(sent(0s, 1), 0.6);  // the house light
  EXPECT_EQ(sent(0s, 2), 0.6);
  mark(2, Mark::solo, false);
  EXPECT_EQ(sent(25ms, 0), 0.6);
}

TEST_F(ModesTest, ParkKeepsALampExactlyWhateverIsAskedOrMasteredButNotInABlackout) {
  build();
  want(0.6);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.6);
  mark(0, Mark::park, true);
  want(0.2);
  wanted_.masters[0] = 0.5;
  post(100ms);
  EXPECT_EQ(sent(100ms, 0), 0.6);
  EXPECT_DOUBLE_EQ(sent(100ms, 2), 0.1);
  governor_->set_blackout(true);
  EXPECT_EQ(sent(200ms, 0), 0);
  governor_->set_blackout(false);
  EXPECT_EQ(sent(300ms, 0), 0.6);
  mark(0, Mark::park, false);
  EXPECT_DOUBLE_EQ(sent(400ms, 0), 0.1);
}

TEST_F(ModesTest, AParkedLampComesBackFromAPowerCutWithoutADip) {
  build();
  want(0.6);
  wanted_.masters[0] = 0.5;
  post(0s);
  EXPECT_DOUBLE_EQ(sent(0s, 0), 0.3);
  mark(0, Mark::park, true);
  wanted_.masters[0] = 0.1;
  post(50ms);
  EXPECT_DOUBLE_EQ(sent(50ms, 0), 0.3);
  const Sent before = report();
  Held held;
  held.fixtures = before.held;
  held.masters = before.masters;
  held.marks = before.marks;
  held.own_marks = before.own_marks;
  build("", "", &held);
  EXPECT_DOUBLE_EQ(sent(0s, 0), 0.3);
  EXPECT_DOUBLE_EQ(sent(0s, 1), 0.06);
}

TEST_F(ModesTest, BlindPreparesALookThatFadesInWhenBlindEnds) {
  build();
  want(0.5);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.5);
  wanted_.blind = true;
  want(1, 2);
  post(100ms);
  EXPECT_EQ(sent(100ms, 0), 0.5);
  EXPECT_EQ(sent(5s, 0), 0.5);
  EXPECT_TRUE(report().blind);
  wanted_.blind = false;
  post(5s);
  EXPECT_EQ(sent(5s, 0), 0.5);
  EXPECT_GT(sent(6s, 0), 0.5);
  EXPECT_LT(sent(6s, 0), 1);
  EXPECT_EQ(sent(7s, 0), 1);
}

TEST_F(ModesTest, ACueLiesAboveTheLookUntilTheNextLook) {
  build();
  want(0.2);
  post(0s);
  SourceState cue;
  cue.fade_s = 1;
  cue.fixtures.resize(3);
  cue.fixtures[0].set(Dof::intensity, 0.9);
  governor_->play(cue, cue, kStart);
  EXPECT_TRUE(governor_->cue_plays());
  EXPECT_EQ(sent(1s, 0), 0.9);
  EXPECT_EQ(sent(1s, 2), 0.2);  // the cue has no opinion on it
  post(2s);                     // the same look again changes nothing
  EXPECT_EQ(sent(2s, 0), 0.9);
  want(0.4, 1);
  post(3s);
  EXPECT_FALSE(governor_->cue_plays());
  EXPECT_EQ(sent(3s, 0), 0.9);
  EXPECT_EQ(sent(4s, 0), 0.4);
}

TEST_F(ModesTest, ALookThatWasTakenBeforeAPowerCutDoesNotEndTheCueOfThen) {
  build();
  want(0.2);
  post(0s);
  Held held;
  held.fixtures.resize(3);
  held.fixtures[0].set(Dof::intensity, 0.9);
  held.fade_id[static_cast<std::size_t>(Source::look)] = 1;
  build("", "", &held);
  SourceState cue;
  cue.fixtures.resize(3);
  cue.fixtures[0].set(Dof::intensity, 0.9);
  governor_->stand_on(cue);
  EXPECT_EQ(sent(0s, 0), 0.9);
  post(0s);  // the look with the id that was known
  EXPECT_TRUE(governor_->cue_plays());
  EXPECT_EQ(sent(0s, 0), 0.9);
  want(0.5);
  post(1s);
  EXPECT_FALSE(governor_->cue_plays());
}

TEST_F(ModesTest, DimsACircuitsLampsInProportionToKeepItsPower) {
  build("circuits:\n  wall: {limit: 500 W, lamps: {a: 1000 W, h: 500 W}}\n");
  want(0.2);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 0.2);
  EXPECT_DOUBLE_EQ(report().circuits[0].draw_w, 300);
  EXPECT_EQ(report().limited[0], 0);
  want(0.8);
  look(2).set(Dof::intensity, 0.4);
  post(100ms);
  EXPECT_DOUBLE_EQ(sent(100ms, 0), 0.4);  // asked 800 + 200 W
  EXPECT_DOUBLE_EQ(sent(100ms, 2), 0.2);
  EXPECT_EQ(sent(100ms, 1), 0.8);  // on another circuit
  const Sent told = report();
  EXPECT_DOUBLE_EQ(told.circuits[0].draw_w, 500);
  EXPECT_DOUBLE_EQ(told.circuits[0].scale, 0.5);
  EXPECT_EQ(told.limited[0], static_cast<Limited>(Limit::power));
  EXPECT_EQ(told.limited[1], 0);
}

TEST_F(ModesTest, CountsAParkedLampOnItsCircuitAndLetsTheOthersShareTheRest) {
  build("circuits:\n  wall: {limit: 500 W, lamps: {a: 400 W, h: 400 W}}\n");
  want(1);
  look(2).set(Dof::intensity, 0);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 1);
  mark(0, Mark::park, true);
  want(0);
  look(2).set(Dof::intensity, 1);
  post(100ms);
  EXPECT_EQ(sent(100ms, 0), 1);
  EXPECT_DOUBLE_EQ(sent(100ms, 2), 0.25);  // what is left: 100 W
  EXPECT_DOUBLE_EQ(report().circuits[0].draw_w, 500);
  governor_->set_blackout(true);
  sent(200ms, 2);
  EXPECT_EQ(report().circuits[0].draw_w, 0);
}

TEST_F(ModesTest, CountsALampThatIsStillOnItsWayDown) {
  build("circuits:\n  wall: {limit: 500 W, lamps: {a: 400 W, h: 400 W}}\n",
        "limits: {dark_to_full: 1 s}");
  want(1);
  look(2).set(Dof::intensity, 0);
  post(0s);
  EXPECT_EQ(sent(0s, 0), 1);
  want(0);
  look(2).set(Dof::intensity, 1);
  post(25ms);
  for (auto at = 25ms; at < 1200ms; at += 25ms) {
    const double a = sent(at, 0), h = sent(at, 2);
    EXPECT_LE(400 * (a + h), 500 + 1e-9 + 400 * 0.05) << at.count();  // a frame behind at most
  }
  EXPECT_EQ(sent(1200ms, 2), 1);
}

TEST_F(ModesTest, KnowsThatFilamentsDrawMoreThanTheirShareOfLight) {
  build("circuits:\n  wall: {limit: 500 W, tungsten: yes, lamps: {a: 1000 W}}\n");
  want(1);
  post(0s);
  const double level = sent(0s, 0);
  EXPECT_NEAR(1000 * std::pow(level, 1.6 / 3.4), 500, 1e-9);
  EXPECT_LT(level, 0.25);
}

TEST_F(ModesTest, MovesNothingUntilAPersonArmsIt) {
  build();
  want(0.5);
  look(2).set(Dof::pan, 1);
  post(0s);
  run(0s, 3s);
  EXPECT_EQ(sent(3s, 2, Dof::pan), 0);
  EXPECT_EQ(report().axes_waiting, 1u);
  EXPECT_EQ(report().limited[2], static_cast<Limited>(Limit::motion));
  governor_->arm_motion(true);
  run(3s, 8s);
  EXPECT_EQ(sent(8s, 2, Dof::pan), 1);
  EXPECT_EQ(report().axes_waiting, 0u);
}

TEST_F(ModesTest, KeepsEveryAxisBelowItsSpeed) {
  build();
  governor_->arm_motion(true);
  want(0.5);
  look(2).set(Dof::pan, 3);
  post(0s);
  double last = sent(0s, 2, Dof::pan);
  const double fastest = 2 * core::kPi / 10 * 0.025;  // end to end in 10 s
  for (ports::Duration at = 25ms; at <= 2s; at += 25ms) {
    const double now = sent(at, 2, Dof::pan);
    EXPECT_LE(now - last, fastest + 1e-12);
    EXPECT_GT(now, last);
    last = now;
  }
  // A loop that was held up does not make it lurch.
  EXPECT_LE(sent(3s, 2, Dof::pan) - last, 0.1 * 2 * core::kPi / 10 + 1e-12);
}

TEST_F(ModesTest, MotionStopFreezesAxesWithTheLightHeldAndItsReleaseMovesNothing) {
  build();
  governor_->arm_motion(true);
  want(0.5, 4);
  look(2).set(Dof::pan, 2);
  post(0s);
  run(0s, 1s);
  const double light = sent(1s, 2), place = sent(1s, 2, Dof::pan);
  EXPECT_GT(place, 0);
  governor_->stop_motion(true);
  run(1025ms, 5s);
  EXPECT_EQ(sent(5s, 2, Dof::pan), place);
  EXPECT_GT(sent(5s, 2), light);  // the fade of the light has gone on
  EXPECT_EQ(sent(5s, 2), 0.5);
  EXPECT_TRUE(report().motion_stop.on);
  governor_->arm_motion(true);  // refused while it is stopped
  EXPECT_FALSE(report().motion_armed.on);
  governor_->stop_motion(false);
  run(5025ms, 6s);
  EXPECT_EQ(sent(6s, 2, Dof::pan), place);
  governor_->arm_motion(true);
  run(6025ms, 12s);
  EXPECT_EQ(sent(12s, 2, Dof::pan), 2);
}

TEST_F(ModesTest, BlackoutDarkensAndMovesNothing) {
  build();
  governor_->arm_motion(true);
  want(0.5);
  look(2).set(Dof::pan, 2);
  post(0s);
  run(0s, 1s);
  const double place = sent(1s, 2, Dof::pan);
  governor_->set_blackout(true);
  run(1025ms, 3s);
  EXPECT_EQ(sent(3s, 2), 0);
  EXPECT_EQ(sent(3s, 2, Dof::pan), place);
}

TEST_F(ModesTest, TakesTheBrainsMotionStopEvenFromAnotherStudioButNotItsArming) {
  build();
  governor_->arm_motion(true);
  wanted_.studio_fingerprint ^= 1u;
  wanted_.motion_stop = {true, 5};
  post(0s);
  sent(0s, 0);
  EXPECT_TRUE(report().motion_stop.on);
  EXPECT_EQ(report().motion_stop.id, 5u);
  wanted_.motion_stop = {false, 6};
  wanted_.motion_armed = {true, 7};
  post(1s);
  EXPECT_FALSE(report().motion_armed.on);
}

TEST_F(ModesTest, ARestartMovesNoAxisThoughTheLookStandsElsewhere) {
  Held held;
  held.fixtures.resize(3);
  held.fixtures[2].set(Dof::pan, 0.7);
  held.fixtures[2].set(Dof::intensity, 0.4);
  for (const bool dark : {false, true}) {
    build(dark ? "safety: {power_up: dark}\n" : "", "", &held);
    want(0.5);
    look(2).set(Dof::pan, 2);
    post(0s);
    run(0s, 2s);
    EXPECT_EQ(sent(2s, 2, Dof::pan), 0.7);
    EXPECT_FALSE(report().motion_armed.on);
  }
}

TEST_F(ModesTest, MovesInBlackToItsNextPlaceBeforeItIsLit) {
  build();
  governor_->arm_motion(true);
  mark(2, Mark::move_in_black, true);
  want(0);
  post(0s);
  run(0s, 100ms);
  want(0.5, 1);
  look(2).set(Dof::pan, 1);
  post(100ms);
  bool lit = false;
  for (ports::Duration at = 125ms; at <= 6s; at += 25ms) {
    const double level = sent(at, 2), place = sent(at, 2, Dof::pan);
    if (level > 0.001) {
      lit = true;
      EXPECT_EQ(place, 1) << "moved in the light";
      EXPECT_EQ(sent(at, 2, Dof::red), 0.5);
    }
  }
  EXPECT_TRUE(lit);
  EXPECT_EQ(sent(6s, 2), 0.5);
  EXPECT_EQ(sent(6s, 0), 0.5);
}

TEST_F(ModesTest, MovesInBlackOnlyAfterItsLightIsOut) {
  build();
  governor_->arm_motion(true);
  want(0.5);
  post(0s);
  run(0s, 100ms);
  mark(2, Mark::move_in_black, true);
  want(0, 2);
  look(2).set(Dof::pan, 1);
  post(100ms);
  for (ports::Duration at = 125ms; at <= 6s; at += 25ms)
    if (sent(at, 2) > 0.001) {
      EXPECT_EQ(sent(at, 2, Dof::pan), 0);
    }
  EXPECT_EQ(sent(6s, 2, Dof::pan), 1);
}

TEST_F(ModesTest, IsNotKeptDarkForEverByAnAxisThatMayNotMove) {
  build();
  mark(2, Mark::move_in_black, true);
  want(0);
  post(0s);
  run(0s, 100ms);
  want(0.5);
  look(2).set(Dof::pan, 1);
  post(100ms);
  run(125ms, 9s);
  EXPECT_EQ(sent(9s, 2), 0);
  run(9025ms, 11s);
  EXPECT_EQ(sent(11s, 2), 0.5);
  EXPECT_EQ(sent(11s, 2, Dof::pan), 0);
}

/// A lamp on a track that leads past the sitter, at the height of the face.
class KeepOutTest : public ModesTest {
 protected:
  void build_track(const std::string& more, double from_y) {
    studio_ = support::studio_from(support::studio_text(
        "  t: {role: key, profile: generic/daylight-dimmer, mode: 1ch, mount: {track: {from: "
        "[-2, " +
            std::to_string(from_y) + ", 1.5], to: [2, " + std::to_string(from_y) +
            ", 1.5], at: 0 %, axis: {channel: 2}}}, limits: {end_to_end: 4 s}, "
            "patch: {universe: 1, address: 1}}\n",
        more));
    governor_.emplace(studio_, kStart);
    governor_->arm_motion(true);
    wanted_ = {};
    wanted_.studio_fingerprint = studio_.fingerprint;
    for (auto& source : wanted_.sources) source.fixtures.resize(1);
    auto& look = wanted_.sources[static_cast<std::size_t>(Source::look)];
    look.fade_id = 1;
    look.fixtures[0].set(Dof::track, 1);
    run(0s, 8s);
  }
  /// Where it stands across the room, in metres.
  double x() { return -2 + 4 * sent(8s, 0, Dof::track); }
};

TEST_F(KeepOutTest, StopsALampBeforeItTouchesTheSitter) {
  build_track("", 0.1);
  EXPECT_EQ(report().limited[0], static_cast<Limited>(Limit::person));
  const double body = studio_.fixtures[0].profile.body_radius;
  EXPECT_LT(x(), -0.5);
  EXPECT_GE(std::hypot(x(), 0.1), kPersonalSpace + body - 1e-9);
  EXPECT_LE(std::hypot(x() + 4.0 / 4 * 0.025, 0.1), kPersonalSpace + body);
}

TEST_F(KeepOutTest, PassesWhereThereIsRoom) {
  build_track("", 1.5);
  EXPECT_DOUBLE_EQ(x(), 2);
  EXPECT_EQ(report().limited[0], 0);
}

TEST_F(KeepOutTest, StopsBeforeAPlaceThatTheStudioFileNames) {
  build_track("keep_out:\n  desk: {at: [1, 1.5, 1.5], radius: 0.5 m}\n", 1.5);
  EXPECT_LT(x(), 0.5);
  EXPECT_GT(x(), 0.2);
}

TEST_F(ModesTest, PassesOverLampsThatHaveArrived) {
  build();
  want(0.5, 1);
  post(0s);
  run(0s, 1200ms);
  EXPECT_TRUE(governor_->step(kStart + 1225ms).changed().empty());
  want(0.6, 1);
  post(1250ms);
  EXPECT_EQ(governor_->step(kStart + 1250ms).changed().size(), 3u);
  run(1275ms, 2500ms);
  EXPECT_TRUE(governor_->step(kStart + 2525ms).changed().empty());
  wanted_.masters[0] = 0.5;
  post(2550ms);
  EXPECT_EQ(governor_->step(kStart + 2550ms).changed().size(), 3u);
}

}  // namespace
}  // namespace chiaro::rig
