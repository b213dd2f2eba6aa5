// SPDX-License-Identifier: Apache-2.0
// Whole Art-Net packets, byte for byte, written down from the Art-Net 4 specification's tables.
#include <gtest/gtest.h>

#include "drivers/common/artnet_packet.h"
#include "tests/golden/drivers/bytes.h"

namespace chiaro::drivers::artnet {
namespace {

using golden::bytes_of;
using golden::numbers;

TEST(ArtNetBytes, ArtDmx) {
  DmxPacket packet = dmx_packet(0x1234);
  std::array<std::uint8_t, kSlots> levels{};
  levels[0] = 0x11;
  levels[1] = 0x22;
  levels[511] = 0xff;
  set_frame(packet, 0xfe, levels);
  auto expected = bytes_of(
      "41 72 74 2d 4e 65 74 00 "  // "Art-Net"
      "00 50 "                    // OpDmx, low byte first
      "00 0e "                    // protocol 14, high byte first
      "fe 00 "                    // sequence, physical port
      "34 12 "                    // sub-net and universe, net
      "02 00 "                    // 512 slots, high byte first
      "11 22");
  expected.resize(18 + 511, 0);
  expected.push_back(0xff);
  EXPECT_EQ(numbers(packet), expected);
}

TEST(ArtNetBytes, ArtPoll) {
  EXPECT_EQ(numbers(poll_packet()), bytes_of("41 72 74 2d 4e 65 74 00 00 20 00 0e 02 00"));
}

TEST(ArtNetBytes, ArtSync) {
  EXPECT_EQ(numbers(sync_packet()), bytes_of("41 72 74 2d 4e 65 74 00 00 52 00 0e 00 00"));
}

TEST(ArtNetBytes, ArtPollReply) {
  Reply reply;
  reply.ip = {10, 0, 0, 7};
  reply.mac = {2, 3, 4, 5, 6, 7};
  reply.short_name = "Lamps";
  reply.long_name = "Lamps of the studio";
  reply.report = "#0001 [0000] ready";
  reply.net = 0x12;
  reply.sub_net = 3;
  reply.ports = {{4, true, false, false}, {5, true, false, true}};
  reply.bind_index = 2;
  auto expected = bytes_of(
      "41 72 74 2d 4e 65 74 00 "
      "00 21 "        // OpPollReply; no protocol version here
      "0a 00 00 07 "  // address
      "36 19 "        // port 6454, low byte first
      "00 00 "        // firmware
      "12 03 "        // net, sub-net
      "00 00 00 "     // OEM, UBEA
      "d0 00 00 ");   // status 1, ESTA maker
  const auto text = [&](const std::string& words, std::size_t field) {
    for (std::size_t i = 0; i < field; ++i)
      expected.push_back(i < words.size() ? static_cast<int>(words[i]) : 0);
  };
  text("Lamps", 18);
  text("Lamps of the studio", 64);
  text("#0001 [0000] ready", 64);
  for (const int byte : bytes_of("00 02 "        // two ports
                                 "80 80 00 00 "  // both put DMX out
                                 "00 00 00 00 "  // inputs
                                 "80 88 00 00 "  // outputs: data, data and merging
                                 "00 00 00 00 "  // universes in
                                 "04 05 00 00 "  // universes out
                                 "00 00 00 "     // sACN priority, macro, remote
                                 "00 00 00 "     // spare
                                 "00 "           // style: a node
                                 "02 03 04 05 06 07 "
                                 "0a 00 00 07 02 "  // bound to this address, index 2
                                 "08"))             // 15-bit port-addresses
    expected.push_back(byte);
  expected.resize(239, 0);
  EXPECT_EQ(numbers(reply_packet(reply)), expected);
}

}  // namespace
}  // namespace chiaro::drivers::artnet
