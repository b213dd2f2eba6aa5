// SPDX-License-Identifier: Apache-2.0
// Contacts, faders and lamps of control surfaces at the hand, from a fake device's line to the
// slots that leave.
#include "controller/daemon/output/desk.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/daemon/box_words.h"
#include "drivers/common/sacn_packet.h"
#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using drivers::SurfaceControl;

class DeskTest : public testing::Test {
 protected:
  DeskTest()
      : studio_(support::studio_from(support::studio_text(
            support::fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1,
                                  "initial: {intensity: 60 %}") +
            support::fixture_line("b", "generic/daylight-dimmer", "1ch", 1, 2)))) {
    around_.threads = false;
    core::Problems warnings;
    Show::Options options;
    options.around = &around_;
    auto show = Show::make(studio_, options, world_.world, nullptr, nullptr, warnings);
    hand_ = std::make_unique<Hand>(std::move(*show));
    report_ = sized_sent(studio_);
    words_.resize(sent_format(studio_).words);
    reader_ =
        std::move(*BoxReader::open(world_.world.runtime_folder / "sent.box", sent_format(studio_)));
    stop_ = world_.devices.plug_gpio("gpiochip0", 17);
    tally_ = world_.devices.plug_gpio("gpiochip0", 5);
    midi_ = world_.devices.plug_midi("nano");
  }

  void control(const std::string& name, const Act& act, Tally tally = Tally::none) {
    gpio_.controls.push_back({name, act, tally});
  }
  SurfaceControl line(const std::string& name, unsigned number, bool output) const {
    SurfaceControl control;
    control.name = name;
    control.gpio = {"gpiochip0", number, output, false, !output};
    return control;
  }
  SurfaceControl fader(const std::string& name, std::uint8_t number) const {
    SurfaceControl control;
    control.name = name;
    control.kind = SurfaceControl::Kind::fader;
    control.midi = SurfaceControl::Midi::controller;
    control.number = number;
    return control;
  }
  void start() {
    gpio_.name = "wall";
    gpio_.driver = "gpio";
    gpio_.settings.controls = {line("stop", 17, false), line("red", 5, true)};
    nano_.name = "nano";
    nano_.driver = "midi";
    nano_.settings.midi_name = "nano";
    nano_.settings.controls = {fader("one", 1), fader("two", 2)};
    desk_ = std::make_unique<Desk>(
        *hand_, around_,
        [this](const studio::Studio&) {
          return std::vector{gpio_, nano_};
        },
        false);
    hand_->start(clock_.now());
    run(300ms);
  }
  /// The loop at its deadlines, the desk every 2 ms, the housekeeper every 50.
  void run(ports::Duration time) {
    const auto end = clock_.now() + time;
    while (clock_.now() < end) {
      if (clock_.now() >= hand_->next_deadline()) hand_->frame(clock_);
      if (clock_.now() >= next_follow_) {
        next_follow_ = clock_.now() + 50ms;
        if (reader_->read(words_)) from_words(words_, report_);
        desk_->follow(studio_, report_);
      }
      desk_->tick();
      clock_.advance(Desk::kTick);
    }
  }
  void move(std::uint8_t number, int value) {
    midi_->to_read.push_back({0xb0, number, static_cast<std::uint8_t>(value)});
    run(50ms);
  }
  /// What is in that slot after the reports have come round.
  double slot(std::size_t which) {
    run(200ms);
    return report_.ports[0].slots[which - 1];
  }

  support::TemporaryFolder folder_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network_;
  support::FakeWorld world_{clock_, network_, folder_.path()};
  drivers::Surroundings around_{world_.world.network, world_.world.devices, world_.world.clock};
  studio::Studio studio_;
  std::unique_ptr<Hand> hand_;
  std::unique_ptr<Desk> desk_;
  std::unique_ptr<BoxReader> reader_;
  std::vector<std::uint64_t> words_;
  rig::Sent report_;
  ports::TimePoint next_follow_;
  std::shared_ptr<support::FakeGpioLine> stop_, tally_;
  std::shared_ptr<support::FakeMidi> midi_;
  SurfacePlan gpio_, nano_;
};

Act doing(Act::Kind kind, Act::Press press) {
  Act act;
  act.kind = kind;
  act.press = press;
  return act;
}
Act master(rig::Master which) {
  Act act;
  act.kind = Act::Kind::master;
  act.master = which;
  return act;
}
Act level(const std::string& fixture) {
  Act act;
  act.kind = Act::Kind::level;
  act.fixture = fixture;
  return act;
}

TEST_F(DeskTest, AContactDarkensOnceItHasSettledAndNothingButAReleaseLightsAgain) {
  control("stop", doing(Act::Kind::blackout, Act::Press::latch), Tally::none);
  control("red", {}, Tally::blackout);
  start();
  EXPECT_EQ(slot(1), 153);
  stop_->level = true;
  run(10ms);
  stop_->level = false;  // it bounces
  run(50ms);
  EXPECT_EQ(slot(1), 153);
  stop_->level = true;
  const auto pressed = clock_.now();
  while (report_.fixtures[0].get(core::Dof::intensity) > 0 && clock_.now() - pressed < 1s) {
    run(Desk::kTick);
    hand_->finish();
    if (reader_->read(words_)) from_words(words_, report_);
  }
  EXPECT_LE(clock_.now() - pressed, 20ms + 2 * Desk::kTick + 25ms);  // debounce, polls, a frame
  EXPECT_EQ(slot(1), 0);
  EXPECT_TRUE(tally_->set_to.back());
  stop_->level = false;
  EXPECT_EQ(slot(1), 0);  // latched
  hand_->wish_blackout(false);
  EXPECT_EQ(slot(1), 153);
  EXPECT_FALSE(tally_->set_to.back());
}

TEST_F(DeskTest, ToggleAndFollowDoWhatTheySay) {
  control("stop", doing(Act::Kind::blackout, Act::Press::toggle));
  start();
  for (const int expected : {0, 153}) {
    stop_->level = true;
    run(100ms);
    stop_->level = false;
    run(100ms);
    EXPECT_EQ(slot(1), expected);
  }
}

TEST_F(DeskTest, AFlashLastsAsLongAsItsButtonIsHeld) {
  Act flash = doing(Act::Kind::mark, Act::Press::follow);
  flash.fixture = "b";
  control("stop", flash);
  start();
  stop_->level = true;
  run(5s);  // longer than a lease
  EXPECT_EQ(slot(2), 255);
  EXPECT_EQ(slot(1), 153);
  stop_->level = false;
  EXPECT_EQ(slot(2), 0);
}

TEST_F(DeskTest, AFaderTakesHoldWhereTheLevelIsSoThatNothingJumps) {
  nano_.controls = {{"one", master(rig::Master::grand), Tally::none},
                    {"two", level("b"), Tally::none}};
  start();
  move(1, 20);  // the master stands at full: the fader is far below
  EXPECT_EQ(slot(1), 153);
  move(1, 126);
  EXPECT_EQ(slot(1), std::lround(0.6 * 126 / 127 * 255));
  move(1, 64);
  EXPECT_EQ(slot(1), std::lround(0.6 * 64 / 127 * 255));
  EXPECT_NEAR(report_.masters[0], 64.0 / 127, 1e-9);
  move(1, 127);
  move(2, 0);
  move(2, 50);
  EXPECT_EQ(slot(2), std::lround(50.0 / 127 * 255));
}

TEST_F(DeskTest, ALetGoFaderDoesNotFightWhoMovesTheMasterElsewhere) {
  nano_.controls = {{"one", master(rig::Master::grand), Tally::none}};
  start();
  move(1, 127);
  move(1, 64);
  Wish wish;
  wish.kind = Wish::Kind::master;
  wish.number = 0.9;
  hand_->wish(wish);
  run(1s);
  move(1, 60);
  run(1s);
  EXPECT_DOUBLE_EQ(report_.masters[0], 0.9);
  move(1, 120);  // passes it, and leads again
  run(1s);
  EXPECT_NEAR(report_.masters[0], 120.0 / 127, 1e-9);
}

TEST_F(DeskTest, AStopContactThatIsLostStopsMotorsAndKeepsTheLight) {
  control("stop", doing(Act::Kind::motion_stop, Act::Press::latch));
  start();
  EXPECT_FALSE(report_.motion_stop.on);
  stop_->plugged = false;
  EXPECT_EQ(slot(1), 153);
  EXPECT_TRUE(report_.motion_stop.on);
  stop_->plugged = true;
  run(3s);
  EXPECT_TRUE(report_.motion_stop.on);
}

TEST_F(DeskTest, ASurfaceThatIsNotThereIsToldOnceAndTakenUpWhenItComes) {
  stop_->plugged = false;
  control("stop", doing(Act::Kind::blackout, Act::Press::latch));
  start();
  run(5s);
  const auto problems = desk_->take_problems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].what.find("surface 'wall'"), std::string::npos);
  stop_->plugged = true;
  stop_->level = true;
  run(3s);
  EXPECT_EQ(slot(1), 0);
}

}  // namespace
}  // namespace chiaro::daemon
