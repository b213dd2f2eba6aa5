// SPDX-License-Identifier: Apache-2.0
// What reaches USB dongles, and which of those that are plugged in is touched at all.
#include <gtest/gtest.h>

#include "drivers/common/usbpro_packet.h"
#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;
using support::Bytes;
using Event = support::FakeSerial::Event;

const ports::DeviceMatch kDongle{"/dev/ttyUSB0", 0x0403, 0x6001, "DMX1", "1-1", "FTDI", "FT232R"};
const ports::DeviceMatch kBus{"/dev/ttyUSB1", 0x0403, 0x6001, "BUS1", "1-2", "FTDI", "FT232R"};

class ADongle : public testing::Test {
 protected:
  std::unique_ptr<ports::OutputPort> make(const std::string& driver) {
    return std::move(*make_output(driver, settings_, stage_.around()));
  }
  support::StageForOutputs stage_{"mock"};
  OutputSettings settings_;
  ports::DmxFrame frame_;
  ports::TimePoint now_ = stage_.clock().now();
};

TEST_F(ADongle, IsTheConfiguredOneAloneWhenAModbusAdapterOfTheSameKindIsThere) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  const auto bus = stage_.devices().plug_serial(kBus);
  dongle->answer = support::usbpro_answers;
  settings_.device.serial = "DMX1";
  for (const char* driver : {"usbpro", "opendmx"}) {
    auto port = make(driver);
    ASSERT_TRUE(port->open());
    for (int i = 0; i < 5; ++i) port->send(frame_, now_);
    port->release(now_);
  }
  EXPECT_EQ(dongle->opens, 2);
  EXPECT_EQ(dongle->open_now, 0);
  EXPECT_EQ(bus->opens, 0);
  EXPECT_EQ(bus->calls, 0);
}

TEST_F(ADongle, IsNotGuessedWhenTwoFit) {
  const auto one = stage_.devices().plug_serial(kDongle);
  const auto two = stage_.devices().plug_serial(kBus);
  settings_.device.vendor = 0x0403;
  const auto opened = make("opendmx")->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.problems()[0].what.find("more than one"), std::string::npos);
  EXPECT_NE(opened.problems()[0].remedy.find("serial: \"DMX1\""), std::string::npos);
  EXPECT_EQ(one->opens + two->opens, 0);
}

TEST_F(ADongle, WithAClonedSerialNumberIsToldApartByItsSocket) {
  auto clone = kBus;
  clone.serial = kDongle.serial;
  const auto one = stage_.devices().plug_serial(kDongle);
  const auto two = stage_.devices().plug_serial(clone);
  settings_.device = {};
  settings_.device.serial = "DMX1";
  const auto refused = make("opendmx")->open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.problems()[0].remedy.find("path: \"1-1\""), std::string::npos);
  settings_.device.usb_path = "1-2";
  EXPECT_TRUE(make("opendmx")->open());
  EXPECT_EQ(one->opens, 0);
  EXPECT_EQ(two->opens, 1);
}

TEST_F(ADongle, ThatComesBackUnderAnotherNodeKeepsItsPatch) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  settings_.device.serial = "DMX1";
  auto port = make("opendmx");
  ASSERT_TRUE(port->open());
  dongle->plugged = false;
  port->send(frame_, now_);
  EXPECT_EQ(port->report().health, ports::PortHealth::lost);
  auto moved = kDongle;
  moved.node = "/dev/ttyUSB7";
  const auto back = stage_.devices().plug_serial(moved);
  ASSERT_TRUE(port->open());
  frame_.levels[0] = 9;
  port->send(frame_, now_);
  EXPECT_EQ(back->all_written().at(1), 9);
  EXPECT_EQ(port->report().reconnects, 1u);
  EXPECT_EQ(dongle->open_now, 0) << "the old handle is not leaked";
}

TEST_F(ADongle, WithoutPermissionSaysSoAndIsNotOpen) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  dongle->forbidden = true;
  settings_.device.serial = "DMX1";
  auto port = make("usbpro");
  const auto opened = port->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.problems()[0].what.find("Permission denied"), std::string::npos);
  EXPECT_EQ(port->report().health, ports::PortHealth::closed);
}

TEST_F(ADongle, OfTheProKindIsAskedWhoItIsAndToldItsTiming) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  dongle->answer = support::usbpro_answers;
  settings_.device.serial = "DMX1";
  settings_.break_us = 300;
  auto port = make("usbpro");
  ASSERT_TRUE(port->open());
  ASSERT_EQ(dongle->events.size(), 2u);
  EXPECT_EQ(dongle->events[0].bytes, (Bytes{0x7e, 3, 2, 0, 0, 0, 0xe7}));
  EXPECT_EQ(dongle->events[1].bytes, (Bytes{0x7e, 4, 5, 0, 0, 0, 29, 2, 40, 0xe7}));
  frame_.levels[0] = 0x7e;  // the start byte in the data is data
  port->send(frame_, now_);
  const Bytes& sent = dongle->events[2].bytes;
  ASSERT_EQ(sent.size(), 518u);
  EXPECT_EQ(sent[1], 6);
  EXPECT_EQ(sent[4], 0) << "the DMX start code";
  EXPECT_EQ(sent[5], 0x7e);
  settings_.dongle_port = 2;
  auto second = make("usbpro");
  ASSERT_TRUE(second->open());
  second->send(frame_, now_);
  EXPECT_EQ(dongle->events.back().bytes[1], 0x65);
}

TEST_F(ADongle, ThatAnswersNothingIsNoProAndGetsNoFrames) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  settings_.device.serial = "DMX1";
  auto port = make("usbpro");
  const auto opened = port->open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.problems()[0].remedy.find("opendmx"), std::string::npos);
  port->send(frame_, now_);
  EXPECT_EQ(dongle->events.size(), 1u) << "the question alone";
}

TEST(UsbProReader, FindsMessagesAmongRubbishAndFalseStarts) {
  usbpro::Reader reader;
  reader.take(Bytes{1, 2, 0x7e, 0x7e, 10, 4, 0, 0x7e, 2, 3});
  EXPECT_FALSE(reader.next());
  reader.take(Bytes{4, 0xe7, 0x7e, 3, 0xff, 0xff, 0x7e, 3, 1, 0, 5, 0xe7});
  auto heard = reader.next();
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->label, 10);
  EXPECT_EQ(heard->data, (Bytes{0x7e, 2, 3, 4}));
  heard = reader.next();
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->data, Bytes{5});
}

TEST_F(ADongle, OfTheOpenKindGetsBreakMarkAndSlotsInThatOrder) {
  const auto dongle = stage_.devices().plug_serial(kDongle);
  settings_.device.serial = "DMX1";
  settings_.slots = 100;
  settings_.break_us = 200;
  settings_.mab_us = 20;
  auto port = make("opendmx");
  ASSERT_TRUE(port->open());
  EXPECT_EQ(dongle->settings.baud, 250000);
  EXPECT_EQ(dongle->settings.stop_bits, 2);
  frame_.levels[99] = 5;
  const auto before = stage_.clock().now();
  port->send(frame_, now_);
  EXPECT_EQ(stage_.clock().now() - before, 220us);
  using Kind = Event::Kind;
  std::vector<Kind> kinds;
  for (const Event& event : dongle->events) kinds.push_back(event.kind);
  EXPECT_EQ(kinds,
            (std::vector<Kind>{Kind::drained, Kind::break_on, Kind::break_off, Kind::written}));
  ASSERT_EQ(dongle->events[3].bytes.size(), 101u);
  EXPECT_EQ(dongle->events[3].bytes[0], 0);
  EXPECT_EQ(dongle->events[3].bytes[100], 5);
  port->send(frame_, now_);  // the break waits until 101 slots of 44 us have left the wire
  EXPECT_EQ(stage_.clock().now() - before, 220us + 101 * 44us + 220us);
}

class AUdmx : public ADongle {
 protected:
  AUdmx()
      : usb_(stage_.devices().plug_usb({"", 0x16c0, 0x05dc, "", "1-3", "www.anyma.ch", "uDMX"})) {
    port_ = make("udmx");
  }
  std::shared_ptr<support::FakeUsb> usb_;
  std::unique_ptr<ports::OutputPort> port_;
};

TEST_F(AUdmx, GetsTheWholeUniverseFirstAndThenOnlyWhatChanged) {
  ASSERT_TRUE(port_->open());
  port_->send(frame_, now_);
  frame_.levels[10] = 1;
  frame_.levels[12] = 3;
  port_->send(frame_, now_);
  port_->send(frame_, now_);
  ASSERT_EQ(usb_->requests.size(), 2u);
  EXPECT_EQ(usb_->requests[0].value, 512);
  EXPECT_EQ(usb_->requests[1], (support::FakeUsb::Request{2, 3, 10, {1, 0, 3}}));
  EXPECT_EQ(port_->report().frames_sent, 3u);
  port_->send(frame_, now_ + 2s);  // and everything again now and then
  EXPECT_EQ(usb_->requests.back().value, 512);
}

TEST_F(AUdmx, SurvivesAStallAndSendsEverythingAfterIt) {
  ASSERT_TRUE(port_->open());
  port_->send(frame_, now_);
  usb_->stall_next = 1;
  frame_.levels[0] = 1;
  port_->send(frame_, now_);
  EXPECT_EQ(port_->report().health, ports::PortHealth::good);
  port_->send(frame_, now_);
  EXPECT_EQ(usb_->requests.back().value, 512);
}

TEST_F(AUdmx, NeverAsksForTheBootLoader) {
  ASSERT_TRUE(port_->open());
  for (int i = 0; i < 512; ++i) {
    frame_.levels.fill(static_cast<std::uint8_t>(i));
    frame_.levels[static_cast<std::size_t>(i)] ^= 0xff;
    port_->send(frame_, now_ + i * 25ms);
  }
  for (const auto& request : usb_->requests) EXPECT_EQ(request.request, 2);
}

TEST_F(AUdmx, IsKnownByItsStringsNotByTheIdsThatManyShare) {
  usb_->plugged = false;
  const auto stranger =
      stage_.devices().plug_usb({"", 0x16c0, 0x05dc, "", "1-4", "somebody", "Thermometer"});
  EXPECT_FALSE(port_->open());
  EXPECT_EQ(stranger->opens, 0);
}

}  // namespace
}  // namespace chiaro::drivers
