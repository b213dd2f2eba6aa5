// SPDX-License-Identifier: Apache-2.0
// Every packet that we can send, as a stranger reads it: Wireshark's dissectors must know each and
// find no fault. Debian 12's Wireshark (4.0) knows no synchronisation and discovery packets of
// sACN: those have their bytes in sacn_bytes_test.cpp alone.
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>

#include "drivers/common/artnet_packet.h"
#include "drivers/common/sacn_packet.h"
#include "tests/support/fake_world.h"

namespace chiaro::drivers {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A capture of one UDP datagram. IPv4's checksum is worked out; UDP's is left 0: "none".
void write_capture(const std::filesystem::path& file, const Bytes& packet, std::uint16_t port) {
  Bytes ip{0x45, 0, 0, 0, 0, 1, 0, 0, 20, 17, 0, 0, 127, 0, 0, 1, 127, 0, 0, 1};
  sacn::put16(ip, 2, 28 + packet.size());
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < ip.size(); i += 2) sum += sacn::get16(ip, i);
  sacn::put16(ip, 10, static_cast<std::uint16_t>(~((sum & 0xffffu) + (sum >> 16u))));
  Bytes udp(8);
  sacn::put16(udp, 0, port);
  sacn::put16(udp, 2, port);
  sacn::put16(udp, 4, 8 + packet.size());
  std::ofstream out(file, std::ios::binary);
  const auto word = [&](std::size_t value) {
    const auto four = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&four), sizeof four);
  };
  for (const std::size_t value : {0xa1b2c3d4u, 0x00040002u, 0u, 0u, 65535u, 101u}) word(value);
  word(0);
  word(0);
  word(28 + packet.size());
  word(28 + packet.size());
  for (const Bytes* part : std::vector<const Bytes*>{&ip, &udp, &packet})
    out.write(reinterpret_cast<const char*>(part->data()),
              static_cast<std::streamsize>(part->size()));
}

std::string dissected(const Bytes& packet, std::uint16_t port) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "one.pcap";
  write_capture(file, packet, port);
  const std::string command = "tshark -r " + file.string() +
                              " --enable-heuristic acn -o acn.dmx_enable:TRUE -V 2>/dev/null";
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> bytes;
  for (std::size_t got = 0; (got = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    text.append(bytes.data(), got);
  ::pclose(pipe);
  return text;
}

struct Packet {
  std::string name;
  std::uint16_t port;
  Bytes bytes;
  std::vector<std::string> said;  ///< what the dissector must say, among much else
};

template <class T>
Bytes bytes(const T& packet) {
  return {packet.begin(), packet.end()};
}

std::vector<Packet> all_packets() {
  sacn::Stream stream;
  stream.cid.fill(0xc5);
  stream.source_name = "Chiaro: test";
  stream.universe = 7;
  stream.sync_universe = 8000;
  const auto levels = sacn::data_packet(stream);
  auto priorities = levels;
  priorities[sacn::at::start_code] = sacn::kAddressPriorities;
  artnet::Reply reply;
  reply.ip = {10, 0, 0, 7};
  reply.short_name = "Lamps";
  reply.ports = {{4, true, false, false}};
  return {
      {"SacnLevels", sacn::kPort, bytes(levels), {"Chiaro: test", "Universe: 7", "8000"}},
      {"SacnPriorities", sacn::kPort, bytes(priorities), {"Chiaro: test"}},
      {"ArtDmx", artnet::kPort, bytes(artnet::dmx_packet(0x1234)), {"Art-Net", "ArtDMX", "512"}},
      {"ArtPoll", artnet::kPort, bytes(artnet::poll_packet()), {"Art-Net", "ArtPoll"}},
      {"ArtSync", artnet::kPort, bytes(artnet::sync_packet()), {"Art-Net", "ArtSync"}},
      {"ArtPollReply",
       artnet::kPort,
       artnet::reply_packet(reply),
       {"Art-Net", "ArtPollReply", "Lamps", "10.0.0.7"}}};
}

class EveryPacket : public testing::TestWithParam<Packet> {};

TEST_P(EveryPacket, IsWholeAndRightToWireshark) {
  const std::string text = dissected(GetParam().bytes, GetParam().port);
  ASSERT_FALSE(text.empty()) << "tshark is needed: apt-get install tshark";
  EXPECT_EQ(text.find("Malformed"), std::string::npos) << text;
  EXPECT_EQ(text.find("Expert Info"), std::string::npos) << text;
  for (const auto& word : GetParam().said)
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

INSTANTIATE_TEST_SUITE_P(, EveryPacket, testing::ValuesIn(all_packets()),
                         [](const auto& packet) { return packet.param.name; });

}  // namespace
}  // namespace chiaro::drivers
