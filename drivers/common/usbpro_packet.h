// SPDX-License-Identifier: Apache-2.0
// The serial framing of the DMX USB Pro and its kin: 7E, label, length (low byte first), data, E7.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace chiaro::drivers::usbpro {

enum class Label : std::uint8_t {
  get_parameters = 3,
  set_parameters = 4,
  received = 5,  ///< a status byte, 0 = whole, and what came from the start code on
  send_dmx = 6,
  send_rdm = 7,
  get_serial = 10,
  rdm_discovery = 11,
  rdm_timeout = 12,  ///< nobody answered
  manufacturer = 77,
  device_name = 78,
  send_dmx_port_1 = 0x64,  ///< DMXking; its second port is the next number
  send_dmx_port_2 = 0x65
};
inline constexpr std::uint8_t kStart = 0x7e, kEnd = 0xe7;
inline constexpr std::size_t kMostData = 600, kHead = 4, kLeastSlots = 24;

std::vector<std::uint8_t> message(Label label, std::span<const std::uint8_t> data);
/// Break and mark are counted in 10.67 us: 9..127 and 1..127 of them; rate in frames a second.
std::vector<std::uint8_t> parameters(int break_us, int mab_us, double rate_hz);

struct Heard {
  std::uint8_t label = 0;
  std::vector<std::uint8_t> data;
};
/// Takes bytes as they come and gives whole messages. 7E also occurs in data: a message counts only
/// when its end stands where its length says; else the search goes on behind that 7E.
class Reader {
 public:
  void take(std::span<const std::uint8_t> bytes) {
    held_.insert(held_.end(), bytes.begin(), bytes.end());
  }
  std::optional<Heard> next();

 private:
  std::vector<std::uint8_t> held_;
};

}  // namespace chiaro::drivers::usbpro
