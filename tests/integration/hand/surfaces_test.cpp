// SPDX-License-Identifier: Apache-2.0
// Control surfaces of a studio file, through the real program and without a brain: from an OSC
// message or a GPIO line to the levels that leave.
#include <bit>
#include <optional>

#include "controller/daemon/output/surface_plan.h"
#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using support::Bytes;

/// An OSC message with one float or none, written here from the specification.
Bytes osc(const std::string& address, std::optional<float> value = std::nullopt) {
  Bytes bytes(address.begin(), address.end());
  const auto pad = [&] {
    bytes.push_back(0);
    while (bytes.size() % 4 != 0) bytes.push_back(0);
  };
  pad();
  bytes.push_back(',');
  if (value) bytes.push_back('f');
  pad();
  if (value)
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(*value) >> shift));
  return bytes;
}

class SurfacesOfTheHand : public RunningHand {
 protected:
  static constexpr std::size_t kWithDesk = kThreads + 1;
  SurfacesOfTheHand() {
    write_studio(support::studio_text(support::fixture_line("a", "generic/daylight-dimmer", "1ch",
                                                            1, 1, "initial: {intensity: 60 %}"),
                                      "surfaces:\n"
                                      "  tablet: {osc: {map: generic/tablet, interface: lo}}\n"
                                      "  wall: {gpio: {map: generic/wall-box}}\n"));
    pad_ = std::move(*network_.open_datagram({"lo", 9001, false, false}));
  }
  void begin() {
    start();
    stop_contact_ = world_->devices.plug_gpio("gpiochip0", 17);
    tally_ = world_->devices.plug_gpio("gpiochip0", 27);
    world_->devices.plug_gpio("gpiochip0", 22);
    run(200ms);  // the desk begins with the first report
    live(5s);    // what was not there at the start is looked for
    hear();
  }
  void live(ports::Duration time) { ASSERT_TRUE(clock_->run_for(time, kWithDesk)); }
  void send(const Bytes& message) { pad_->send({"127.0.0.1", 9000}, message); }
  /// The newest level of slot 1 after a while.
  int later() {
    hear();
    live(400ms);
    return level(1);
  }
  std::unique_ptr<ports::DatagramSocket> pad_;
  std::shared_ptr<support::FakeGpioLine> stop_contact_, tally_;
};

TEST_F(SurfacesOfTheHand, AnOscMessageBlacksOutAndReleases) {
  begin();
  EXPECT_EQ(later(), 153);
  send(osc("/chiaro/blackout/on", 1.0f));
  EXPECT_EQ(later(), 0);
  send(osc("/chiaro/blackout/on", 0.0f));  // the finger is lifted: nothing changes
  EXPECT_EQ(later(), 0);
  send(osc("/chiaro/blackout/off"));
  EXPECT_EQ(later(), 153);
}

TEST_F(SurfacesOfTheHand, AContactBlacksOutAfterItsDebounceAndStaysLatched) {
  begin();
  EXPECT_EQ(later(), 153);
  EXPECT_TRUE(tally_->set_to.back()) << "light is on";
  stop_contact_->level = true;
  live(10ms);
  stop_contact_->level = false;  // shorter than 20 ms: it bounced
  EXPECT_EQ(later(), 153);
  stop_contact_->level = true;
  EXPECT_EQ(later(), 0);
  EXPECT_FALSE(tally_->set_to.back());
  stop_contact_->level = false;
  EXPECT_EQ(later(), 0) << "nothing on the wall lights again";
  send(osc("/chiaro/blackout/off"));
  EXPECT_EQ(later(), 153);
}

TEST_F(SurfacesOfTheHand, AFaderOnATabletIsAMaster) {
  begin();
  send(osc("/chiaro/master/grand", 1.0f));
  send(osc("/chiaro/master/grand", 0.5f));
  EXPECT_NEAR(later(), 153 / 2.0, 1);
  send(osc("/chiaro/master/key", 1.0f));
  send(osc("/chiaro/master/key", 0.0f));
  EXPECT_EQ(later(), 0);
}

TEST_F(SurfacesOfTheHand, WorkAgainWhenTheirWiresAreBackAndNothingElseSuffers) {
  begin();
  stop_contact_->plugged = false;
  EXPECT_EQ(later(), 153);
  stop_contact_->plugged = true;
  stop_contact_->level = true;
  live(5s);
  EXPECT_EQ(later(), 0);
}

TEST(SurfacePlan, BindsEveryDeedAndWhatIsShown) {
  const auto studio = support::studio_from(support::studio_text(
      support::fixture_line("hair", "generic/daylight-dimmer", "1ch", 1, 1),
      "surfaces:\n  desk: {midi: {map: korg/nanokontrol2, do: {fader 6: {level: hair}, stop: "
      "[blackout on, motion stop], play: {cue: 3}, track left: {flash: hair}}}}\n"));
  const auto plans = surface_plans(studio);
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].driver, "midi");
  EXPECT_EQ(plans[0].settings.midi_name, "nanoKONTROL2");
  const auto bound = [&](const std::string& name) {
    std::vector<BoundControl> all;
    for (const auto& control : plans[0].controls)
      if (control.control == name) all.push_back(control);
    return all;
  };
  const auto stop = bound("stop");
  ASSERT_EQ(stop.size(), 3u);
  EXPECT_EQ(stop[0].act.kind, Act::Kind::blackout);
  EXPECT_EQ(stop[0].act.press, Act::Press::latch);
  EXPECT_EQ(stop[1].act.kind, Act::Kind::motion_stop);
  EXPECT_EQ(stop[2].act.kind, Act::Kind::none);
  EXPECT_EQ(stop[2].tally, Tally::blackout);
  const auto fader = bound("fader 6");
  ASSERT_EQ(fader.size(), 2u);
  EXPECT_EQ(fader[0].act.kind, Act::Kind::level);
  EXPECT_EQ(fader[0].act.fixture, "hair");
  EXPECT_EQ(fader[1].tally, Tally::level);
  EXPECT_EQ(fader[1].act.fixture, "hair");
  const auto play = bound("play");
  ASSERT_EQ(play.size(), 1u);
  EXPECT_EQ(play[0].act.kind, Act::Kind::cue_to);
  EXPECT_EQ(play[0].act.cue, 3);
  EXPECT_EQ(play[0].tally, Tally::cue);
  EXPECT_EQ(bound("track left")[0].act.mark, rig::Mark::flash);
  EXPECT_EQ(bound("track left")[0].act.press, Act::Press::follow);
}

}  // namespace
}  // namespace chiaro::daemon
