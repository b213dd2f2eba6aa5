// SPDX-License-Identifier: Apache-2.0
// Messages of the DMX USB Pro, byte for byte, from Enttec's API description 1.44.
#include <gtest/gtest.h>

#include "drivers/common/usbpro_packet.h"
#include "tests/golden/drivers/bytes.h"

namespace chiaro::drivers::usbpro {
namespace {

using golden::bytes_of;
using golden::numbers;

TEST(UsbProBytes, SendDmxCarriesTheStartCodeFirst) {
  std::vector<std::uint8_t> data(513);
  data[1] = 0x11;
  data[512] = 0xff;
  auto expected = bytes_of("7e 06 01 02 00 11");  // 513 = 0x0201, low byte first
  expected.resize(4 + 512, 0);
  expected.push_back(0xff);
  expected.push_back(0xe7);
  EXPECT_EQ(numbers(message(Label::send_dmx, data)), expected);
}

TEST(UsbProBytes, GetParametersAsksForNoUserData) {
  const std::vector<std::uint8_t> none(2);
  EXPECT_EQ(numbers(message(Label::get_parameters, none)), bytes_of("7e 03 02 00 00 00 e7"));
}

TEST(UsbProBytes, SetParametersCountsIn10Point67MicrosecondsRoundedUp) {
  // 176 / 10.67 = 16.5 -> 17; 16 / 10.67 = 1.5 -> 2; 40 frames a second.
  EXPECT_EQ(numbers(parameters(176, 16, 40)), bytes_of("7e 04 05 00 00 00 11 02 28 e7"));
  // Never below 9 (96 us) and 1; never above 127 and 40.
  EXPECT_EQ(numbers(parameters(92, 1, 100)), bytes_of("7e 04 05 00 00 00 09 01 28 e7"));
  EXPECT_EQ(numbers(parameters(9000, 9000, 0.1)), bytes_of("7e 04 05 00 00 00 7f 7f 01 e7"));
}

}  // namespace
}  // namespace chiaro::drivers::usbpro
