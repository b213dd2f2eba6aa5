// SPDX-License-Identifier: Apache-2.0
// Enttec DMX USB Pro and compatibles (DMXking, Robe…): the dongle times the frames itself and goes
// on sending the last one when the computer falls silent.
#include <algorithm>

#include "drivers/common/usbpro_packet.h"
#include "drivers/registry.h"

namespace chiaro::drivers::usbpro {
namespace {

using namespace std::chrono_literals;

class UsbProPort final : public ports::OutputPort {
 public:
  UsbProPort(const OutputSettings& settings, Surroundings& around)
      : settings_(settings), around_(around) {}

  core::Result<core::Done> open() override {
    line_.reset();
    // The chip is a USB one: the baud rate is a formality.
    auto line = around_.devices.open_serial(settings_.device, {57600, 8, 1, 'N'});
    if (!line) return line.problems();
    if (!identify(**line))
      return core::Problem{{},
                           to_string(settings_.device) + " does not answer as a DMX USB Pro",
                           "an adapter without a processor of its own is {opendmx: …}"};
    if (!(*line)->write(parameters(settings_.break_us, settings_.mab_us, settings_.rate_hz)))
      return core::Problem{{}, to_string(settings_.device) + " went away", "plug it in again"};
    line_ = std::move(*line);
    if (was_lost_) ++report_.reconnects;
    was_lost_ = false;
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint) override {
    if (!line_) return;
    std::array<std::uint8_t, 1 + ports::kSlots> data{};  // the start code comes first
    std::copy(frame.levels.begin(), frame.levels.end(), data.begin() + 1);
    const auto label = settings_.dongle_port == 2 ? Label::send_dmx_port_2 : Label::send_dmx;
    if (line_->write(message(label, data))) {
      ++report_.frames_sent;
      return;
    }
    ++report_.frames_failed;
    line_.reset();
    was_lost_ = true;
    report_.health = ports::PortHealth::lost;
  }

  /// The dongle goes on with the last frame: it has no goodbye.
  void release(ports::TimePoint) override {
    line_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }
  bool blocks() const override { return true; }

 private:
  /// Asks for the parameters, which every one of the family knows.
  bool identify(ports::SerialPort& line) {
    constexpr std::array<std::uint8_t, 2> kNoUserData{};
    if (!line.write(message(Label::get_parameters, kNoUserData))) return false;
    Reader reader;
    const auto end = around_.clock.now() + 500ms;
    // Counted as well as timed: what talks without end is no such dongle either.
    for (int i = 0; i < 50 && around_.clock.now() <= end; ++i) {
      std::array<std::uint8_t, 256> bytes;
      const auto got = line.read(bytes, 20ms);
      if (!got) return false;
      reader.take(std::span(bytes).first(*got));
      while (const auto heard = reader.next())
        if (heard->label == static_cast<std::uint8_t>(Label::get_parameters)) return true;
    }
    return false;
  }

  const OutputSettings settings_;
  Surroundings& around_;
  std::unique_ptr<ports::SerialPort> line_;
  bool was_lost_ = false;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<UsbProPort>(settings, around);
}

}  // namespace chiaro::drivers::usbpro
