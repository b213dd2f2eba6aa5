// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/usbpro_rdm.h"

#include <array>

#include "drivers/common/usbpro_packet.h"

namespace chiaro::drivers::usbpro {
namespace {

using namespace std::chrono_literals;

/// A lamp answers within 3 ms; the dongle and USB take the rest.
constexpr ports::Duration kAnswer = 200ms;

class RdmLine final : public rdm::Line {
 public:
  RdmLine(std::unique_ptr<ports::SerialPort> line, ports::Clock& clock)
      : line_(std::move(line)), clock_(clock) {}

  /// The firmware's major number; nothing when it does not answer as a DMX USB Pro.
  std::optional<int> firmware() {
    constexpr std::array<std::uint8_t, 2> kNoUserData{};
    if (!line_->write(message(Label::get_parameters, kNoUserData))) return std::nullopt;
    const auto heard = wait_for(Label::get_parameters, Label::get_parameters, 500ms);
    if (!heard || heard->data.size() < 2) return std::nullopt;
    return heard->data[1];
  }

  std::optional<rdm::Bytes> exchange(std::span<const std::uint8_t> packet,
                                     bool discovery) override {
    forget_what_came();
    const bool broadcast = !discovery && packet[3] == 0xff && packet[4] == 0xff;
    if (!line_->write(message(discovery ? Label::rdm_discovery : Label::send_rdm, packet)))
      return std::nullopt;
    if (broadcast) {
      clock_.sleep_until(clock_.now() + 5ms);
      return rdm::Bytes{};
    }
    const auto heard = wait_for(Label::received, Label::rdm_timeout, kAnswer);
    if (gone_) return std::nullopt;
    // A timeout, or a status byte and then what came.
    if (!heard || heard->label != static_cast<std::uint8_t>(Label::received) ||
        heard->data.size() < 2)
      return rdm::Bytes{};
    return rdm::Bytes(heard->data.begin() + 1, heard->data.end());
  }

 private:
  /// Late answers must not be taken for those to the next question.
  void forget_what_came() {
    std::array<std::uint8_t, 600> bytes;
    for (int i = 0; i < 100; ++i) {
      const auto got = line_->read(bytes, {});
      if (!got || *got == 0) break;
      reader_.take(std::span(bytes).first(*got));
    }
    while (reader_.next()) {
    }
  }
  std::optional<Heard> wait_for(Label one, Label other, ports::Duration patience) {
    const auto end = clock_.now() + patience;
    // Counted as well as timed: what talks without end is no such dongle either.
    for (int i = 0; i < 100 && clock_.now() <= end; ++i) {
      while (const auto heard = reader_.next())
        if (heard->label == static_cast<std::uint8_t>(one) ||
            heard->label == static_cast<std::uint8_t>(other))
          return heard;
      std::array<std::uint8_t, 600> bytes;
      const auto got = line_->read(bytes, 20ms);
      gone_ = !got;
      if (gone_) return std::nullopt;
      reader_.take(std::span(bytes).first(*got));
    }
    return std::nullopt;
  }

  std::unique_ptr<ports::SerialPort> line_;
  ports::Clock& clock_;
  Reader reader_;
  bool gone_ = false;
};

}  // namespace

core::Result<std::unique_ptr<rdm::Line>> open_rdm(const ports::DeviceMatch& device,
                                                  Surroundings& around) {
  auto serial = around.devices.open_serial(device, {57600, 8, 1, 'N'});
  if (!serial) return serial.problems();
  auto line = std::make_unique<RdmLine>(std::move(*serial), around.clock);
  const auto firmware = line->firmware();
  if (!firmware)
    return core::Problem{{},
                         to_string(device) + " does not answer as a DMX USB Pro",
                         "an adapter without a processor of its own cannot hear lamps"};
  constexpr int kWithRdm = 2;
  if (*firmware < kWithRdm)
    return core::Problem{{},
                         to_string(device) + " has firmware " + std::to_string(*firmware) +
                             ".x, which sends DMX alone",
                         "load its maker's RDM firmware (2.x) with his own tool"};
  return std::unique_ptr<rdm::Line>(std::move(line));
}

}  // namespace chiaro::drivers::usbpro
