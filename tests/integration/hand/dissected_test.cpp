// SPDX-License-Identifier: Apache-2.0
// Our packets as a stranger reads them: Wireshark's dissector must find every field and no fault.
#include <array>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "drivers/common/sacn_packet.h"
#include "tests/support/fake_world.h"

namespace chiaro::drivers::sacn {
namespace {

/// A capture file of one UDP datagram from 127.0.0.1 to the universe's group. IPv4's checksum is
/// worked out; UDP's is left 0, which means "none".
void write_capture(const std::filesystem::path& file, const Packet& packet) {
  const auto total = static_cast<std::uint16_t>(20 + 8 + packet.size());
  std::vector<std::uint8_t> ip{0x45, 0, 0,   0, 0, 1, 0,   0,   20, 17,
                               0,    0, 127, 0, 0, 1, 239, 255, 0,  7};
  put16(ip, 2, total);
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < ip.size(); i += 2) sum += get16(ip, i);
  put16(ip, 10, static_cast<std::uint16_t>(~((sum & 0xffffu) + (sum >> 16u))));
  std::vector<std::uint8_t> udp(8);
  put16(udp, 0, 50000);
  put16(udp, 2, kPort);
  put16(udp, 4, 8 + packet.size());
  std::ofstream out(file, std::ios::binary);
  const auto word = [&](std::uint32_t value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::uint32_t value : {0xa1b2c3d4u, 0x00040002u, 0u, 0u, 65535u, 101u}) word(value);
  for (const std::uint32_t value : {0u, 0u, std::uint32_t{total}, std::uint32_t{total}})
    word(value);
  for (const auto* part : {&ip, &udp})
    out.write(reinterpret_cast<const char*>(part->data()),
              static_cast<std::streamsize>(part->size()));
  out.write(reinterpret_cast<const char*>(packet.data()),
            static_cast<std::streamsize>(packet.size()));
}

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> bytes;
  for (std::size_t got = 0; (got = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    text.append(bytes.data(), got);
  ::pclose(pipe);
  return text;
}

TEST(SacnPackets, AreWholeAndRightToWireshark) {
  ASSERT_FALSE(output_of("command -v tshark").empty()) << "apt-get install tshark";
  Stream stream;
  stream.cid.fill(0xc5);
  stream.source_name = "Chiaro: test";
  stream.priority = 123;
  stream.universe = 7;
  Packet packet = data_packet(stream);
  std::array<std::uint8_t, kSlots> levels{};
  levels[0] = 0x11;
  levels[511] = 0xee;
  set_frame(packet, 42, 0, levels);
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "one.pcap";
  write_capture(file, packet);
  const std::string read =
      "tshark -r " + file.string() + " --enable-heuristic acn -o acn.dmx_enable:TRUE ";
  const std::string whole = output_of(read + "-V 2>/dev/null");
  EXPECT_EQ(whole.find("Malformed"), std::string::npos) << whole;
  EXPECT_EQ(whole.find("Expert Info"), std::string::npos) << whole;
  const std::string fields = output_of(
      read +
      "-T fields -e acn.cid -e acn.dmx.source_name -e acn.dmx.priority -e acn.dmx.seq_number "
      "-e acn.dmx.universe -e acn.dmx.count 2>/dev/null");
  EXPECT_NE(fields.find("c5c5c5c5-c5c5-c5c5-c5c5-c5c5c5c5c5c5\tChiaro: test\t123\t42\t7\t513"),
            std::string::npos)
      << fields << whole;
}

}  // namespace
}  // namespace chiaro::drivers::sacn
