// SPDX-License-Identifier: Apache-2.0
// Slots of a lamp without a profile, on the wire of the real output program.
#include <chrono>

#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using support::fixture_line;
using namespace std::chrono_literals;

/// Universe 1: a four-channel wash in slots 1 to 4; universe 2: a dimmer in slot 1.
class TriedSlotsTest : public RunningHand {
 protected:
  TriedSlotsTest() {
    write_studio(support::studio_text(fixture_line("a", "generic/rgbw", "4ch", 1, 1) +
                                      fixture_line("b", "generic/daylight-dimmer", "1ch", 2, 1)));
  }
  rig::Wanted trying(std::uint16_t slot, std::uint8_t level, ports::Duration time) {
    rig::Wanted wanted;
    wanted.tried[0] = {1, slot, level};
    wanted.tried_until_ns = (clock_->now() + time).time_since_epoch().count();
    return wanted;
  }
};

TEST_F(TriedSlotsTest, RaisesASlotThatNobodyHasAndLetsItFallInTime) {
  start();
  auto link = brain();
  run(100ms);
  link->post(trying(20, 128, 3s), clock_->now());
  run(500ms);
  EXPECT_EQ(level(20), 128);
  run(4s);
  EXPECT_EQ(level(20), 0);
}

TEST_F(TriedSlotsTest, LeavesTheSlotsOfOtherLampsAlone) {
  start();
  auto link = brain();
  run(100ms);
  for (const int slot : {1, 4, 0, 513})
    link->post(trying(static_cast<std::uint16_t>(slot), 200, 3s), clock_->now());
  run(500ms);
  for (const auto& packet : hear())
    for (std::size_t slot = 1; slot <= 512; ++slot) ASSERT_EQ(packet.level(slot), 0);
}

TEST_F(TriedSlotsTest, ReportsWhatIsOnTheWire) {
  start();
  auto link = brain();
  run(100ms);
  link->post(trying(20, 128, 3s), clock_->now());
  run(500ms);
  const auto report = link->report();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->ports[0].slots[19], 128);
}

TEST_F(TriedSlotsTest, NoWordKeepsASlotUpLongerThanTheHandAllows) {
  start();
  auto link = brain();
  run(100ms);
  link->post(trying(20, 128, 1h), clock_->now());
  run(5s);
  EXPECT_EQ(level(20), 128);
  run(6s);
  EXPECT_EQ(level(20), 0) << "the person, or the brain, has gone away";
}

TEST_F(TriedSlotsTest, ABlackoutDarkensTheseSlotsToo) {
  start();
  auto link = brain();
  run(100ms);
  rig::Wanted wanted = trying(20, 128, 5s);
  wanted.blackout = true;
  wanted.blackout_id = 1;
  link->post(wanted, clock_->now());
  run(500ms);
  EXPECT_EQ(level(20), 0);
}

}  // namespace
}  // namespace chiaro::daemon
