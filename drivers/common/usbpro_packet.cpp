// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/usbpro_packet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro::drivers::usbpro {

std::vector<std::uint8_t> message(Label label, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> bytes(kHead + data.size() + 1);
  bytes[0] = kStart;
  bytes[1] = static_cast<std::uint8_t>(label);
  bytes[2] = static_cast<std::uint8_t>(data.size() & 0xffu);
  bytes[3] = static_cast<std::uint8_t>(data.size() >> 8u);
  std::copy(data.begin(), data.end(), bytes.begin() + kHead);
  bytes.back() = kEnd;
  return bytes;
}

std::vector<std::uint8_t> parameters(int break_us, int mab_us, double rate_hz) {
  constexpr double kUnit = 10.67;
  const auto units = [](int us, int least) {
    // Rounded up: the times are minima.
    const int count = static_cast<int>(std::ceil(us / kUnit));
    return static_cast<std::uint8_t>(std::clamp(count, least, 127));
  };
  const auto rate = static_cast<std::uint8_t>(std::clamp(std::lround(rate_hz), 1L, 40L));
  // The first two bytes count the user data that follow: none.
  const std::array<std::uint8_t, 5> data{0, 0, units(break_us, 9), units(mab_us, 1), rate};
  return message(Label::set_parameters, data);
}

std::optional<Heard> Reader::next() {
  while (true) {
    held_.erase(held_.begin(), std::find(held_.begin(), held_.end(), kStart));
    if (held_.size() <= kHead) return std::nullopt;
    const std::size_t length = held_[2] | static_cast<std::size_t>(held_[3]) << 8u;
    if (length <= kMostData && held_.size() < kHead + length + 1) return std::nullopt;
    if (length > kMostData || held_[kHead + length] != kEnd) {
      held_.erase(held_.begin());
      continue;
    }
    const auto data = held_.begin() + kHead;
    const auto end = data + static_cast<std::ptrdiff_t>(length);
    Heard heard{held_[1], {data, end}};
    held_.erase(held_.begin(), end + 1);
    return heard;
  }
}

}  // namespace chiaro::drivers::usbpro
