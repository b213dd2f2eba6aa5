// SPDX-License-Identifier: Apache-2.0
// Art-Net 4 packets as bytes: levels, polls and their answers, and synchronisation. Pure; sockets
// live in the drivers. The operation code is little-endian, almost everything else big-endian.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro::drivers::artnet {

inline constexpr std::uint16_t kPort = 6454;
inline constexpr std::size_t kSlots = 512, kDmxHead = 18, kDmxSize = kDmxHead + kSlots;
inline constexpr std::size_t kPollSize = 14, kSyncSize = 14, kReplySize = 239, kLeastReply = 207;
/// Port-addresses have 15 bits: net 7, sub-net 4, universe 4. The first one is 0.
inline constexpr int kMostPortAddress = 32767;
inline constexpr std::uint8_t kProtocol = 14;

enum class Operation : std::uint16_t {
  poll = 0x2000,
  poll_reply = 0x2100,
  dmx = 0x5000,
  nzs = 0x5100,
  sync = 0x5200
};

using DmxPacket = std::array<std::uint8_t, kDmxSize>;

/// A whole ArtDmx of 512 zero levels, sequence 0 (unused).
DmxPacket dmx_packet(int port_address);
/// Real-time. Sequence numbers are 1 to 255.
void set_frame(DmxPacket& packet, std::uint8_t sequence,
               std::span<const std::uint8_t, kSlots> levels);

std::array<std::uint8_t, kPollSize> poll_packet();
std::array<std::uint8_t, kSyncSize> sync_packet();

/// What a node says of itself, for up to four ports of one kind.
struct Reply {
  std::array<std::uint8_t, 4> ip{};
  std::array<std::uint8_t, 6> mac{};
  std::string short_name, long_name, report;
  std::uint8_t net = 0, sub_net = 0;
  struct Port {
    std::uint8_t universe = 0;  ///< low four bits of the port-address
    bool output = false;        ///< Art-Net comes out as DMX
    bool input = false;         ///< DMX goes out as Art-Net
    bool merging = false;
  };
  std::vector<Port> ports;  ///< at most 4
  std::uint8_t bind_index = 1;
  std::uint8_t style = 0;  ///< 0 = node, 1 = controller
};
std::vector<std::uint8_t> reply_packet(const Reply& reply);

/// The operation of a datagram that is Art-Net of a protocol that we know. Real-time.
std::optional<Operation> operation_of(std::span<const std::uint8_t> datagram);

/// An ArtDmx as received; views into the datagram.
struct HeardDmx {
  int port_address = 0;
  std::uint8_t sequence = 0;  ///< 0 = the sender does not number
  std::span<const std::uint8_t> levels;
};
/// Refuses lengths that are odd, above 512, or longer than the datagram. Real-time.
std::optional<HeardDmx> parse_dmx(std::span<const std::uint8_t> datagram);

/// The parts of an ArtPollReply that a controller needs, without allocation. Real-time.
struct HeardReply {
  std::array<std::uint8_t, 4> ip{};
  std::uint8_t bind_index = 0;
  std::size_t outputs = 0;
  std::array<std::uint16_t, 4> port_addresses{};  ///< of its output ports
};
std::optional<HeardReply> parse_reply(std::span<const std::uint8_t> datagram);
/// The short name in an ArtPollReply.
std::string name_in_reply(std::span<const std::uint8_t> datagram);

/// As E1.31's rule, for numbers that run from 1 to 255: late when up to 20 behind. 0 is always new.
bool in_sequence(std::uint8_t last, std::uint8_t next);

std::optional<std::array<std::uint8_t, 4>> bytes_of(const std::string& dotted);
std::string dotted(const std::array<std::uint8_t, 4>& address);

}  // namespace chiaro::drivers::artnet
