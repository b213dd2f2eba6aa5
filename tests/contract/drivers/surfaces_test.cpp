// SPDX-License-Identifier: Apache-2.0
// What must be true of every control surface in drivers.def: one button is pressed on each.
#include <gtest/gtest.h>

#include "drivers/registry.h"
#include "tests/support/stage_for_outputs.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;
using support::Bytes;

/// A surface of the kind with one button called "stop" that has a lamp, and somebody to press it.
class EverySurface : public testing::TestWithParam<SurfaceEntry> {
 protected:
  EverySurface() {
    SurfaceControl stop{.name = "stop"};
    const std::string name(GetParam().name);
    if (name == "midi") {
      midi_ = stage_.devices().plug_midi("Desk");
      settings_.midi_name = "Desk";
      stop.midi = SurfaceControl::Midi::note;
      stop.number = 7;
    } else if (name == "hid") {
      hid_ = stage_.devices().plug_hid({"/dev/hidraw3", 0x1209, 0xbeef, "S1", "1-1", "", ""});
      settings_.device.serial = "S1";
      settings_.report_size = 2;
      stop.byte = 1;
      stop.bit = 3;
      stop.lamp_byte = 1;
    } else if (name == "gpio") {
      gpio_ = stage_.devices().plug_gpio("gpiochip0", 4);
      stop.gpio = {"gpiochip0", 4, false, false, false};
    } else if (name == "osc") {
      pad_ = std::move(*stage_.network().open_datagram({"lo", 9001, false, false}));
      settings_.interface = "lo";
      stop.osc = "/stop";
    } else {
      known_ = name == "mock";
    }
    settings_.controls = {stop};
    surface_ = GetParam().make(settings_, stage_.around());
  }
  void SetUp() override { ASSERT_TRUE(known_) << "give it a far end here"; }
  bool touchable() const { return GetParam().name != "mock"; }

  void press(bool down) {
    if (midi_) midi_->to_read.push_back({0x90, 7, static_cast<std::uint8_t>(down ? 127 : 0)});
    if (hid_) hid_->to_read.push_back({0, static_cast<std::uint8_t>(down ? 8 : 0)});
    if (gpio_) gpio_->level = down;
    if (pad_) {
      Bytes message{'/', 's', 't', 'o', 'p', 0, 0, 0, ',', 'i', 0, 0, 0, 0, 0, 0};
      message.back() = down ? 1 : 0;
      pad_->send({"127.0.0.1", settings_.port}, message);
    }
  }
  void plug(bool in) {
    for (auto* far : {static_cast<support::FakeDevice*>(midi_.get()),
                      static_cast<support::FakeDevice*>(hid_.get()),
                      static_cast<support::FakeDevice*>(gpio_.get())})
      if (far != nullptr) far->plugged = in;
  }
  std::vector<ports::SurfaceEvent> listen() {
    std::vector<ports::SurfaceEvent> all;
    for (int i = 0; i < 10; ++i) {
      now_ += 5ms;
      for (auto& event : surface_->listen(now_)) all.push_back(event);
    }
    return all;
  }
  using Events = std::vector<ports::SurfaceEvent>;

  support::StageForOutputs stage_{"mock"};
  SurfaceSettings settings_;
  std::shared_ptr<support::FakeMidi> midi_;
  std::shared_ptr<support::FakeHid> hid_;
  std::shared_ptr<support::FakeGpioLine> gpio_;
  std::unique_ptr<ports::DatagramSocket> pad_;
  std::unique_ptr<ports::Surface> surface_;
  ports::TimePoint now_ = stage_.clock().now();
  bool known_ = true;
};

TEST_P(EverySurface, HearsNothingBeforeItIsOpened) {
  EXPECT_EQ(surface_->health(), ports::PortHealth::closed);
  press(true);
  EXPECT_TRUE(listen().empty());
}

TEST_P(EverySurface, TellsAPressAndAReleaseOnceEach) {
  ASSERT_TRUE(surface_->open());
  EXPECT_EQ(surface_->health(), ports::PortHealth::good);
  press(true);
  EXPECT_EQ(listen(), touchable() ? Events({{"stop", 1}}) : Events{});
  EXPECT_TRUE(listen().empty());
  press(false);
  EXPECT_EQ(listen(), touchable() ? Events({{"stop", 0}}) : Events{});
}

TEST_P(EverySurface, TakesFeedbackForWhatItHasAndForWhatItHasNot) {
  ASSERT_TRUE(surface_->open());
  press(true);
  listen();
  surface_->show("stop", 1, "BLACKOUT");
  surface_->show("no such thing", 1, "");
  EXPECT_EQ(surface_->health(), ports::PortHealth::good);
  if (midi_) {
    EXPECT_EQ(midi_->written.back(), (Bytes{0x90, 7, 127}));
  }
  if (hid_) {
    EXPECT_EQ(hid_->written.back(), (Bytes{0, 1}));
  }
  if (pad_) {
    Bytes bytes(64);
    const auto size = pad_->receive(bytes, nullptr);
    ASSERT_TRUE(size);
    EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 5), "/stop");
  }
}

TEST_P(EverySurface, IsLostWhenItIsPulledAndWorksAgainWhenItIsBack) {
  ASSERT_TRUE(surface_->open());
  press(true);
  listen();
  plug(false);
  EXPECT_TRUE(listen().empty());
  const bool has_a_plug = midi_ || hid_ || gpio_;
  EXPECT_EQ(surface_->health(), has_a_plug ? ports::PortHealth::lost : ports::PortHealth::good);
  surface_->show("stop", 1, "");
  if (has_a_plug) {
    EXPECT_FALSE(surface_->open());
  }
  plug(true);
  ASSERT_TRUE(surface_->open());
  press(false);
  listen();
  press(true);
  EXPECT_EQ(listen(), touchable() ? Events({{"stop", 1}}) : Events{});
  if (hid_) {
    EXPECT_EQ(hid_->open_now, 1);
  }
}

TEST_P(EverySurface, SurvivesMessagesThatMakeNoSense) {
  ASSERT_TRUE(surface_->open());
  for (std::size_t size = 1; size < 12; ++size)
    for (const int value : {0x00, 0x2f, 0x7f, 0xff}) {
      const Bytes rubbish(size, static_cast<std::uint8_t>(value));
      if (midi_) midi_->to_read.push_back(rubbish);
      if (pad_) pad_->send({"127.0.0.1", settings_.port}, rubbish);
    }
  if (hid_) hid_->to_read.push_back({});
  listen();
  EXPECT_EQ(surface_->health(), ports::PortHealth::good);
}

INSTANTIATE_TEST_SUITE_P(, EverySurface, testing::ValuesIn(surfaces().begin(), surfaces().end()),
                         [](const auto& about) { return std::string(about.param.name); });

TEST(GpioSurface, IgnoresWhatIsShorterThanItsDebounceTime) {
  support::StageForOutputs stage("mock");
  const auto line = stage.devices().plug_gpio("gpiochip0", 4);
  SurfaceSettings settings;
  SurfaceControl stop{.name = "stop"};
  stop.gpio = {"gpiochip0", 4, false, true, true};  // a contact that opens: low is at rest
  stop.debounce = 20ms;
  line->level = true;
  settings.controls = {stop};
  auto surface = std::move(*make_surface("gpio", settings, stage.around()));
  ASSERT_TRUE(surface->open());
  ports::TimePoint now = stage.clock().now();
  const auto after = [&](ports::Duration wait) {
    now += wait;
    return surface->listen(now);
  };
  EXPECT_TRUE(after(5ms).empty());
  line->level = false;  // bounces
  EXPECT_TRUE(after(5ms).empty());
  line->level = true;
  EXPECT_TRUE(after(5ms).empty());
  line->level = false;
  EXPECT_TRUE(after(5ms).empty());
  EXPECT_TRUE(after(15ms).empty());
  EXPECT_EQ(after(5ms), (std::vector<ports::SurfaceEvent>{{"stop", 1}}));
}

TEST(OscSurface, KeepsWhatComesWithinItsRangeAndDropsWhatIsNoNumber) {
  support::StageForOutputs stage("mock");
  SurfaceSettings settings;
  settings.interface = "lo";
  SurfaceControl fader{.name = "fader", .kind = SurfaceControl::Kind::fader};
  fader.osc = "/f";
  settings.controls = {fader};
  auto pad = std::move(*stage.network().open_datagram({"lo", 9001, false, false}));
  auto surface = std::move(*make_surface("osc", settings, stage.around()));
  ASSERT_TRUE(surface->open());
  for (const std::uint32_t bits : {0x7fc00000u, 0x7f800000u, 0x60000000u, 0xe0000000u}) {
    Bytes message{'/', 'f', 0, 0, ',', 'f', 0, 0};  // NaN, infinity, 3.7e19, -3.7e19
    for (int shift = 24; shift >= 0; shift -= 8)
      message.push_back(static_cast<std::uint8_t>(bits >> shift));
    pad->send({"127.0.0.1", settings.port}, message);
  }
  EXPECT_EQ(surface->listen({}), (std::vector<ports::SurfaceEvent>{{"fader", 1}, {"fader", 0}}));
}

TEST(MidiSurface, ReadsFadersEncodersAndPitchBend) {
  support::StageForOutputs stage("mock");
  const auto far = stage.devices().plug_midi("Desk");
  SurfaceSettings settings;
  settings.midi_name = "Desk";
  using Control = SurfaceControl;
  Control fader{.name = "fader", .kind = Control::Kind::fader};
  fader.midi = Control::Midi::controller;
  fader.number = 48;
  Control wheel{.name = "wheel", .kind = Control::Kind::encoder};
  wheel.midi = Control::Midi::controller;
  wheel.number = 16;
  Control motor{.name = "motor", .kind = Control::Kind::fader};
  motor.midi = Control::Midi::pitch_bend;
  motor.channel = 2;
  settings.controls = {fader, wheel, motor};
  auto surface = std::move(*make_surface("midi", settings, stage.around()));
  ASSERT_TRUE(surface->open());
  for (const Bytes& message : {Bytes{0xb0, 48, 127}, Bytes{0xb0, 16, 127}, Bytes{0xb0, 16, 2},
                               Bytes{0xe2, 0x7f, 0x7f}, Bytes{0xe0, 1, 1}})
    far->to_read.push_back(message);
  EXPECT_EQ(surface->listen({}), (std::vector<ports::SurfaceEvent>{
                                     {"fader", 1}, {"wheel", -1}, {"wheel", 2}, {"motor", 1}}));
  surface->show("motor", 1, "");
  EXPECT_EQ(far->written.back(), (Bytes{0xe2, 0x7f, 0x7f}));
}

}  // namespace
}  // namespace chiaro::drivers
