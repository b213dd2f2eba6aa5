// SPDX-License-Identifier: Apache-2.0
// A motor behind registers, on a line in memory and a fake clock: when it is told to move, and when
// it must not be.
#include "drivers/common/modbus_axis.h"

#include <gtest/gtest.h>

#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers::modbus {
namespace {

using namespace std::chrono_literals;
using Write = support::FakeModbus::Write;

/// Registers: 0-1 target, 10-11 actual, 12 flags, 20 home, 21 stop; 0 to 100000 steps in ten
/// seconds.
class AMotor : public testing::Test {
 protected:
  static constexpr std::uint16_t kTarget = 0, kActual = 10, kFlags = 12, kHome = 20, kStop = 21;
  AMotor() {
    far_ = devices_.plug_modbus("10.0.0.5");
    far_->clock = &clock_;
    far_->units[3].takes = 2ms;
    settings_.unit = 3;
    settings_.timeout = 100ms;
    settings_.words = 2;
    settings_.to = 100000;
    settings_.actual = kActual;
    settings_.status = kFlags;
    settings_.moving_bit = 0;
    settings_.homed_bit = 1;
    settings_.fault_bit = 2;
    settings_.home = kHome;
    settings_.stop = kStop;
  }
  void start() {
    ports::ModbusLine line;
    line.host = "10.0.0.5";
    axis_.reset();
    bus_ = std::make_unique<Bus>(devices_, clock_, line, false);
    axis_ = std::make_unique<Axis>(settings_);
    bus_->add(*axis_);
  }
  void stands_at(int steps) {
    far_->units[3].holding[kActual] = static_cast<std::uint16_t>(steps >> 16);
    far_->units[3].holding[kActual + 1] = static_cast<std::uint16_t>(steps & 0xffff);
  }
  void want(double share) {
    const auto raw = static_cast<unsigned>(share * 65535 + 0.5);
    levels_[0] = static_cast<std::uint8_t>(raw >> 8u);
    levels_[1] = static_cast<std::uint8_t>(raw & 0xffu);
    axis_->put(levels_);
  }
  /// Lives that long; the motor is where it was told to be.
  void live(ports::Duration how_long, bool follows = true) {
    const auto end = clock_.now() + how_long;
    while (clock_.now() < end) {
      while (bus_->step(clock_.now())) {
      }
      if (follows && !targets().empty()) stands_at(targets().back());
      clock_.advance(10ms);
    }
  }
  /// Every target written so far, in steps.
  std::vector<int> targets() const {
    std::vector<int> all;
    for (const Write& write : far_->writes)
      if (write.address == kTarget && write.values.size() == 2)
        all.push_back(write.values[0] << 16 | write.values[1]);
    return all;
  }
  int count(std::uint16_t address) const {
    return static_cast<int>(std::count_if(far_->writes.begin(), far_->writes.end(),
                                          [&](const Write& w) { return w.address == address; }));
  }

  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeDevices devices_;
  std::shared_ptr<support::FakeModbus> far_;
  AxisSettings settings_;
  std::unique_ptr<Bus> bus_;
  std::unique_ptr<Axis> axis_;
  std::array<std::uint8_t, 512> levels_{};
};

TEST_F(AMotor, IsNotMovedByAStart) {
  stands_at(80000);
  start();
  want(0.2);  // what the last run left
  live(3s);
  EXPECT_TRUE(far_->writes.empty());
  EXPECT_NEAR(axis_->report().place, 0.8, 1e-6);
  EXPECT_NEAR(axis_->report().wanted, 0.2, 1e-4);
}

TEST_F(AMotor, IsLedFromWhereItIsAtItsPace) {
  stands_at(80000);
  start();
  want(0.2);
  live(1s);
  want(0.3);  // a person asks: it stood at 0.8 all the while
  live(1s);
  ASSERT_FALSE(targets().empty());
  int before = 80000;
  for (const int target : targets()) {
    EXPECT_LE(std::abs(target - before), 2600) << "a quarter second's way at the most";
    before = target;
  }
  EXPECT_NEAR(before, 70000, 1500) << "a tenth of the way in a second";
  live(5s);
  EXPECT_NEAR(targets().back(), 30000, 2);
  const auto written = far_->writes.size();
  live(5s);
  EXPECT_EQ(far_->writes.size(), written) << "there: nothing is repeated";
}

TEST_F(AMotor, SaysWhereItIsAndHowItStands) {
  stands_at(25000);
  far_->units[3].holding[kFlags] = 0b011;
  start();
  want(0.25);
  live(1s);
  const auto report = axis_->report();
  EXPECT_NEAR(report.place, 0.25, 1e-6);
  EXPECT_TRUE(report.moving);
  EXPECT_TRUE(report.homed);
  EXPECT_FALSE(report.fault);
  EXPECT_TRUE(report.heard);
  EXPECT_TRUE(report.can_home);
}

TEST_F(AMotor, CountsBelowZeroAndBackwards) {
  settings_.from = 500;
  settings_.to = -500;
  settings_.words = 1;
  settings_.status = -1;
  far_->units[3].holding[kActual] = static_cast<std::uint16_t>(-250);
  start();
  want(0.75);
  live(1s, false);
  EXPECT_NEAR(axis_->report().place, 0.75, 1e-6);
  want(0.7501);
  want(1);
  live(200ms, false);
  ASSERT_FALSE(far_->writes.empty());
  const auto first = static_cast<std::int16_t>(far_->writes.front().values.at(0));
  EXPECT_LT(first, -250);
  EXPECT_GT(first, -300);
  live(9s, false);
  EXPECT_EQ(static_cast<std::int16_t>(far_->writes.back().values.at(0)), -500);
}

TEST_F(AMotor, StopsBeforeEverybodyElseAndStaysWhenTheStopIsReleased) {
  stands_at(0);
  start();
  want(0);
  live(1s);
  want(1);
  live(1s);
  const auto moved = targets().size();
  ASSERT_GT(moved, 3u);
  axis_->stop(true);
  EXPECT_TRUE(axis_->urgent());
  ASSERT_TRUE(bus_->step(clock_.now()));
  EXPECT_EQ(far_->writes.back(), (Write{3, kStop, {1}, true}));
  live(2s);
  axis_->stop(false);
  live(2s);
  EXPECT_EQ(targets().size(), moved) << "releasing moves nothing";
  EXPECT_EQ(count(kStop), 1);
  want(0.9);  // another wish does
  live(1s);
  EXPECT_GT(targets().size(), moved);
}

TEST_F(AMotor, WithoutAnOrderToStopIsToldToBeWhereItIs) {
  settings_.stop = -1;
  stands_at(0);
  start();
  want(0);
  live(1s);
  want(1);
  live(1s);
  stands_at(9000);
  live(500ms, false);
  axis_->stop(true);
  while (bus_->step(clock_.now())) {
  }
  EXPECT_NEAR(targets().back(), 9000, 20);
}

TEST_F(AMotor, IsToldToStopUntilItHasHeard) {
  stands_at(0);
  start();
  want(0);
  live(1s);
  far_->lose_next = 2;
  axis_->stop(true);
  live(3s);
  EXPECT_EQ(count(kStop), 1) << "two were lost, the third was heard";
}

TEST_F(AMotor, IsHomedOnlyByAnOrderAndOnce) {
  stands_at(0);
  start();
  want(0.5);
  live(2s);
  EXPECT_EQ(count(kHome), 0);
  axis_->home();
  live(2s);
  EXPECT_EQ(count(kHome), 1);
  axis_->stop(true);
  axis_->home();
  live(1s);
  axis_->stop(false);
  live(1s);
  EXPECT_EQ(count(kHome), 1) << "what was ordered in a stop is dropped";
}

TEST_F(AMotor, AnOrderThatWasNotHeardIsDropped) {
  start();
  want(0.5);
  live(1s);
  far_->units[3].silent = true;
  axis_->home();
  live(2s);
  EXPECT_FALSE(axis_->report().heard);
  far_->units[3].silent = false;
  live(10s);
  EXPECT_EQ(count(kHome), 0);
  EXPECT_TRUE(axis_->report().heard);
}

TEST_F(AMotor, OneLostMessageDoesNotEndAMove) {
  stands_at(0);
  start();
  want(0);
  live(1s);
  want(0.5);
  live(1s);
  far_->lose_next = 1;
  live(12s);
  EXPECT_NEAR(targets().back(), 50000, 2);
}

TEST_F(AMotor, DoesNotGoOnWhenItHasBeenAway) {
  stands_at(0);
  start();
  want(0);
  live(1s);
  want(1);
  live(1s);
  far_->units[3].silent = true;
  live(10s);
  const auto written = targets().size();
  far_->units[3].silent = false;
  live(10s);
  EXPECT_EQ(targets().size(), written) << "whoever switched it on again may stand beside it";
  far_->plugged = false;
  live(1s);
  want(0.8);
  far_->plugged = true;
  live(10s);
  EXPECT_EQ(targets().size(), written);
  want(0.7);
  live(10s);
  EXPECT_NEAR(targets().back(), 70000, 2);
}

TEST(AModbusPort, CarriesLampsAndMotorsAndPassesOrdersOn) {
  support::StageForOutputs stage("modbus");
  OutputSettings settings = stage.settings();
  AxisSettings axis;
  axis.unit = settings.module.unit;
  axis.slot = 4;
  axis.target = 100;
  axis.home = 120;
  axis.stop = 121;
  settings.axes = {axis};
  auto port = std::move(*make_output("modbus", settings, stage.around()));
  ASSERT_TRUE(port->open());
  ports::DmxFrame frame;
  const auto live = [&] {
    for (int i = 0; i < 10; ++i) {
      stage.clock().advance(50ms);
      port->send(frame, stage.clock().now());
    }
  };
  live();
  ASSERT_EQ(port->axes().size(), 1u);
  EXPECT_EQ(port->axes()[0].slot, 4);
  EXPECT_EQ(port->axes()[0].place, -1) << "it does not say";
  const auto& writes = stage.modbus()->writes;
  const auto said = [&](std::uint16_t address) {
    return std::count_if(writes.begin(), writes.end(),
                         [&](const Write& write) { return write.address == address; });
  };
  EXPECT_EQ(said(100), 0);
  port->order({ports::AxisOrder::Kind::home, 4});
  port->order({ports::AxisOrder::Kind::home, 6});
  live();
  EXPECT_EQ(said(120), 1);
  frame.levels[4] = 255;
  live();
  EXPECT_GT(said(100), 2);
  port->order({ports::AxisOrder::Kind::stop, 0});
  live();
  EXPECT_EQ(said(121), 1);
  const auto before = said(100);
  live();
  EXPECT_EQ(said(100), before);
}

}  // namespace
}  // namespace chiaro::drivers::modbus
