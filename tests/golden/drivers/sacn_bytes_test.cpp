// SPDX-License-Identifier: Apache-2.0
// A whole E1.31 data packet, byte for byte, written down from ANSI E1.31-2018 (tables 4-1 to 4-3).
#include <gtest/gtest.h>
#include <sstream>
#include <vector>

#include "drivers/common/sacn_packet.h"

namespace chiaro::drivers::sacn {
namespace {

std::vector<int> bytes_of(const std::string& hexadecimal) {
  std::istringstream in(hexadecimal);
  std::vector<int> bytes;
  for (std::string word; in >> word;) bytes.push_back(std::stoi(word, nullptr, 16));
  return bytes;
}

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

}  // namespace
}  // namespace chiaro::drivers::sacn
