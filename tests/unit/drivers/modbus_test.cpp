// SPDX-License-Identifier: Apache-2.0
// A Modbus line in memory, on a fake clock: who gets which turn, and what is said.
#include <gtest/gtest.h>
#include <set>

#include "drivers/common/modbus_bus.h"
#include "drivers/common/modbus_module.h"
#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers::modbus {
namespace {

using namespace std::chrono_literals;
using Write = support::FakeModbus::Write;

TEST(RegisterValue, FollowsTheDaliLawOfTheStandard) {
  Channel dali;
  dali.law = Channel::Law::dali;
  EXPECT_EQ(register_value(dali, 0), 0u);
  EXPECT_EQ(register_value(dali, 0.001), 1u);
  EXPECT_EQ(register_value(dali, 0.00991), 85u);
  EXPECT_EQ(register_value(dali, 0.03206), 128u);
  EXPECT_EQ(register_value(dali, 0.22892), 200u);
  EXPECT_EQ(register_value(dali, 1), 254u);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_LE(register_value(dali, i / 1000.0), 254u) << "255 is MASK";
}

TEST(RegisterValue, ScalesBothWaysAndNeverLeavesItsRegister) {
  Channel millivolts;
  millivolts.to = 10000;
  EXPECT_EQ(register_value(millivolts, 0.5), 5000u);
  EXPECT_EQ(register_value(millivolts, 7), 10000u);
  Channel sinking;
  sinking.from = 255;
  sinking.to = 0;
  EXPECT_EQ(register_value(sinking, 1), 0u);
}

class ALine : public testing::Test {
 protected:
  ALine() {
    far_ = devices_.plug_modbus("10.0.0.5");
    far_->clock = &clock_;
    for (const int unit : {1, 2}) far_->units[static_cast<std::uint8_t>(unit)].takes = 10ms;
    ports::ModbusLine line;
    line.host = "10.0.0.5";
    bus_ = std::make_unique<Bus>(devices_, clock_, line, false);
  }
  std::unique_ptr<Module> module(std::uint8_t unit, std::vector<Channel> channels,
                                 ports::Duration gap = {}) {
    ModuleSettings settings;
    settings.unit = unit;
    settings.timeout = 100ms;
    settings.least_gap = gap;
    settings.channels = std::move(channels);
    auto made = std::make_unique<Module>(settings);
    bus_->add(*made);
    return made;
  }
  static std::vector<Channel> channels(int count, double to = 255) {
    std::vector<Channel> all;
    for (int i = 0; i < count; ++i)
      all.push_back({.slot = static_cast<std::uint16_t>(i),
                     .address = static_cast<std::uint16_t>(i),
                     .to = to});
    return all;
  }
  void set(int slot, std::uint8_t level) { levels_[static_cast<std::size_t>(slot)] = level; }
  /// Every turn that is due now.
  int turns() {
    int count = 0;
    while (bus_->step(clock_.now())) ++count;
    return count;
  }
  /// What was written since the last call.
  std::vector<Write> written() {
    auto all = std::move(far_->writes);
    far_->writes.clear();
    return all;
  }

  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeDevices devices_;
  std::shared_ptr<support::FakeModbus> far_;
  std::unique_ptr<Bus> bus_;
  std::array<std::uint8_t, 512> levels_{};
};

TEST_F(ALine, SaysEverythingOnceInOneMessageAndThenOnlyWhatChanged) {
  const auto one = module(1, channels(8));
  EXPECT_EQ(turns(), 0) << "nothing has been laid down";
  one->put(levels_);
  EXPECT_EQ(turns(), 1);
  EXPECT_EQ(written(), (std::vector<Write>{{1, 0, {0, 0, 0, 0, 0, 0, 0, 0}, false}}));
  set(2, 20);
  set(4, 40);  // the clean one between two is cheaper said than left out
  one->put(levels_);
  EXPECT_EQ(turns(), 1);
  EXPECT_EQ(written(), (std::vector<Write>{{1, 2, {20, 0, 40}, false}}));
  one->put(levels_);
  EXPECT_EQ(turns(), 0);
}

TEST_F(ALine, CarriesTheNewestValueAndPassesOverThoseBetween) {
  const auto one = module(1, channels(1));
  for (std::uint8_t level = 1; level <= 100; ++level) {
    set(0, level);
    one->put(levels_);
  }
  turns();
  EXPECT_EQ(written(), (std::vector<Write>{{1, 0, {100}, false}}));
}

TEST_F(ALine, RefreshesADeviceThatMayHaveLostItsPower) {
  const auto one = module(1, channels(2));
  set(1, 9);
  one->put(levels_);
  turns();
  written();
  clock_.advance(1s);
  EXPECT_EQ(turns(), 0);
  clock_.advance(1100ms);
  EXPECT_GE(turns(), 1);
  EXPECT_EQ(written(), (std::vector<Write>{{1, 0, {0, 9}, false}}));
}

TEST_F(ALine, LetsASilentDeviceCostTheOthersOneTimeoutAndThenWaitsLonger) {
  far_->units[1].silent = true;
  const auto silent = module(1, channels(1)), well = module(2, channels(1));
  silent->put(levels_);
  int served = 0, asked = 0;
  const auto end = clock_.now() + 10s;
  while (clock_.now() < end) {
    set(0, static_cast<std::uint8_t>(levels_[0] + 1));
    well->put(levels_);
    turns();
    served += static_cast<int>(written().size());
    clock_.advance(10ms);
  }
  asked = static_cast<int>(silent->failed());
  EXPECT_LE(asked, 6);  // 0.25, 0.5, 1, 2, 4 … seconds apart
  EXPECT_GE(asked, 4);
  EXPECT_GT(served, 400);
  EXPECT_FALSE(silent->answers());
  EXPECT_TRUE(well->answers());
  far_->units[1].silent = false;
  clock_.advance(5s);
  turns();
  EXPECT_TRUE(silent->answers());
}

TEST_F(ALine, GivesEachDeviceItsOwnTimeout) {
  const auto one = module(1, channels(1));
  one->put(levels_);
  turns();
  EXPECT_EQ(far_->timeouts.back(), 100ms);
  far_->units[1].takes = 150ms;
  set(0, 1);
  one->put(levels_);
  turns();
  EXPECT_FALSE(one->answers());
}

TEST_F(ALine, KeepsTheGapThatASlowDeviceAsksForAndServesAllItsLampsInTurn) {
  std::vector<Channel> lamps;
  for (int i = 0; i < 64; ++i)  // 100 registers apart: no two fit into one message
    lamps.push_back({.slot = static_cast<std::uint16_t>(i),
                     .address = static_cast<std::uint16_t>(15 + 100 * i),
                     .to = 100});
  const auto gateway = module(1, lamps, 32ms);
  const auto start = clock_.now();
  gateway->put(levels_);
  std::size_t all = 0;
  while (all < 64 && clock_.now() - start < 10s) {
    set(0, static_cast<std::uint8_t>(levels_[0] + 5));  // one lamp fades all the time
    gateway->put(levels_);
    turns();
    clock_.advance(4ms);
    std::set<std::uint16_t> told;
    for (const auto& write : far_->writes) told.insert(write.address);
    all = told.size();
  }
  EXPECT_EQ(all, 64u) << "the fading lamp must not starve the others";
  EXPECT_GE(clock_.now() - start, 63 * 32ms);
}

TEST_F(ALine, WritesWordsInTheOrderThatTheMakerChose) {
  const auto one =
      module(1, {{.slot = 0, .address = 10, .words = 2, .to = 0x12345678},
                 {.slot = 1, .address = 12, .words = 2, .low_word_first = true, .to = 0x12345678}});
  levels_.fill(255);
  one->put(levels_);
  turns();
  EXPECT_EQ(written(), (std::vector<Write>{{1, 10, {0x1234, 0x5678, 0x5678, 0x1234}, false}}));
}

TEST_F(ALine, SplitsWhatIsLongerThanAMessageMayBe) {
  const auto one = module(1, channels(200));
  one->put(levels_);
  EXPECT_EQ(turns(), 2);
  const auto all = written();
  EXPECT_EQ(all[0].values.size(), 123u);
  EXPECT_EQ(all[1].address, 123);
}

TEST_F(ALine, UsesSingleWritesWhereADeviceKnowsNoOther) {
  ModuleSettings settings;
  settings.channels = channels(3);
  settings.single_writes = true;
  Module one(settings);
  bus_->add(one);
  one.put(levels_);
  EXPECT_EQ(turns(), 3);
  for (const auto& write : written()) EXPECT_TRUE(write.single);
}

TEST_F(ALine, OpensALostLineAgainAndSaysEverythingAnew) {
  const auto one = module(1, channels(2));
  one->put(levels_);
  turns();
  written();
  far_->plugged = false;
  set(0, 5);
  one->put(levels_);
  turns();
  EXPECT_FALSE(bus_->is_open());
  clock_.advance(1s);
  turns();
  far_->plugged = true;
  clock_.advance(2s);
  turns();
  EXPECT_TRUE(bus_->is_open());
  EXPECT_EQ(written(), (std::vector<Write>{{1, 0, {5, 0}, false}}));
  EXPECT_EQ(far_->open_now, 1);
}

TEST_F(ALine, LetsAnUrgentClientGoFirst) {
  struct Stop final : Client {
    ports::TimePoint due(ports::TimePoint) const override { return ports::TimePoint::max(); }
    bool urgent() const override { return asked; }
    ports::ModbusLink::Outcome turn(ports::ModbusLink& link, ports::TimePoint) override {
      asked = false;
      const std::uint16_t zero = 0;
      return link.write(2, 99, {&zero, 1}, 10ms);
    }
    bool asked = true;
  } stop;
  const auto one = module(1, channels(1));
  bus_->add(stop);
  one->put(levels_);
  turns();
  const auto all = written();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].address, 99);
  bus_->remove(stop);
}

TEST(ModbusPorts, OfOneLineShareItsSchedulerAndItsConnection) {
  support::StageForOutputs stage("modbus");
  stage.modbus()->units[2] = {};
  auto settings = stage.settings();
  auto first = std::move(*make_output("modbus", settings, stage.around()));
  settings.module.unit = 2;
  auto second = std::move(*make_output("modbus", settings, stage.around()));
  ASSERT_TRUE(first->open() && second->open());
  EXPECT_EQ(stage.modbus()->opens, 1);
  ports::DmxFrame frame;
  frame.levels[0] = 255;
  const auto now = stage.clock().now();
  first->send(frame, now);
  second->send(frame, now);
  EXPECT_EQ(stage.modbus()->units[2].holding[0], 65535);
  stage.modbus()->units[1].silent = true;
  frame.levels[0] = 1;
  first->send(frame, now + 1s);
  second->send(frame, now + 1s);
  EXPECT_EQ(first->report().health, ports::PortHealth::lost);
  EXPECT_EQ(second->report().health, ports::PortHealth::good);
  first->release(now);
  second->release(now);
  EXPECT_EQ(stage.modbus()->open_now, 0);
}

}  // namespace
}  // namespace chiaro::drivers::modbus
