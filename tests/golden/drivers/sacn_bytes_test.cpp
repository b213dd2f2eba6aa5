// SPDX-License-Identifier: Apache-2.0
// A whole E1.31 data packet, byte for byte, written down from ANSI E1.31-2018 (tables 4-1 to 4-3).
#include <gtest/gtest.h>

#include "drivers/common/sacn_packet.h"
#include "tests/golden/drivers/bytes.h"

namespace chiaro::drivers::sacn {
namespace {

using golden::bytes_of;
using golden::numbers;

TEST(SacnBytes, AreThoseOfTheStandard) {
  Stream stream;
  for (std::size_t i = 0; i < stream.cid.size(); ++i)
    stream.cid[i] = static_cast<std::uint8_t>(0xa0 + i);
  stream.source_name = "Chiaro";
  stream.priority = 123;
  stream.universe = 0x0107;
  Packet packet = data_packet(stream);
  std::array<std::uint8_t, kSlots> levels{};
  levels[0] = 0x11;
  levels[1] = 0x22;
  levels[511] = 0xff;
  set_frame(packet, 0xfe, kTerminated, levels);

  std::vector<int> golden = bytes_of(
      "00 10 00 00 "                                      // preamble, postamble
      "41 53 43 2d 45 31 2e 31 37 00 00 00 "              // "ASC-E1.17"
      "72 6e 00 00 00 04 "                                // root: 0x26e = 622 bytes, vector 4
      "a0 a1 a2 a3 a4 a5 a6 a7 a8 a9 aa ab ac ad ae af "  // CID
      "72 58 00 00 00 02 "                                // framing: 0x258 = 600, vector 2
      "43 68 69 61 72 6f ");                              // "Chiaro"
  golden.resize(108, 0);
  for (const int byte : bytes_of("7b 00 00 fe 40 01 07 "     // priority, sync, sequence, options,
                                                             // universe
                                 "72 0b 02 a1 00 00 00 01 "  // DMP: 0x20b = 523, vector 2, type,
                                                             // first, step
                                 "02 01 00 11 22"))          // 513 values, start code, levels
    golden.push_back(byte);
  golden.resize(637, 0);
  golden.push_back(0xff);

  EXPECT_EQ(std::vector<int>(packet.begin(), packet.end()), golden);
}

TEST(SacnBytes, KeepANulBehindTheLongestName) {
  Stream stream;
  const std::string longer(80, 'x');
  stream.source_name = longer;
  const Packet packet = data_packet(stream);
  EXPECT_EQ(packet[at::source_name + 62], 'x');
  EXPECT_EQ(packet[at::source_name + 63], 0);
}

/// Root layer of an extended packet: `length` bytes follow the preamble, vector 8.
std::string root(const std::string& length) {
  return "00 10 00 00 41 53 43 2d 45 31 2e 31 37 00 00 00 " + length +
         " 00 00 00 08 a0 a1 a2 a3 a4 a5 a6 a7 a8 a9 aa ab ac ad ae af ";
}
Cid a_cid() {
  Cid cid{};
  for (std::size_t i = 0; i < cid.size(); ++i) cid[i] = static_cast<std::uint8_t>(0xa0 + i);
  return cid;
}

TEST(SacnBytes, OfASynchronisationPacket) {
  SyncPacket packet = sync_packet(a_cid(), 0x1f40);
  packet[sync_at::sequence] = 0x67;
  EXPECT_EQ(numbers(packet), bytes_of(root("70 21") +       // 49 - 16 = 33
                                      "70 0b 00 00 00 01 "  // framing: 49 - 38 = 11, vector 1
                                      "67 1f 40 00 00"));   // sequence, universe 8000, reserved
}

TEST(SacnBytes, OfAUniverseDiscoveryPage) {
  Stream stream;
  stream.cid = a_cid();
  stream.source_name = "Chiaro";
  const std::vector<std::uint16_t> universes{1, 2, 0x0107};
  auto expected = bytes_of(root("70 6e") +             // 126 - 16 = 110
                           "70 58 00 00 00 02 "        // framing: 126 - 38 = 88, vector 2
                           "43 68 69 61 72 6f");       // "Chiaro"
  expected.resize(112, 0);                             // 64 letters, 4 reserved
  for (const int byte : bytes_of("70 0e 00 00 00 01 "  // list: 126 - 112 = 14, vector 1
                                 "00 00 "              // page 0 of 0
                                 "00 01 00 02 01 07"))
    expected.push_back(byte);
  EXPECT_EQ(numbers(discovery_page(stream, 0, 0, universes)), expected);
}

TEST(SacnBytes, OfASynchronisedDataPacketNameTheirUniverse) {
  Stream stream;
  stream.sync_universe = 0x1f40;
  const Packet packet = data_packet(stream);
  EXPECT_EQ(packet[109], 0x1f);
  EXPECT_EQ(packet[110], 0x40);
}

}  // namespace
}  // namespace chiaro::drivers::sacn
