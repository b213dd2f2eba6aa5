// SPDX-License-Identifier: Apache-2.0
// The E1.31 data packet as bytes: built once per universe and patched per frame, and read back as
// strictly as a node must. Pure; sockets live in the driver. Numbers are ANSI E1.31-2018's.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro::drivers::sacn {

inline constexpr std::uint16_t kPort = 5568;
inline constexpr std::uint16_t kLeastUniverse = 1, kMostUniverse = 63999;
inline constexpr std::uint8_t kDefaultPriority = 100, kMostPriority = 200;
inline constexpr std::size_t kSlots = 512, kPacketSize = 638, kSourceNameSize = 64;

/// Where the fields sit on the wire. Everything is big-endian.
namespace at {
inline constexpr std::size_t preamble = 0, postamble = 2, identifier = 4, root_length = 16,
                             root_vector = 18, cid = 22, framing_length = 38, framing_vector = 40,
                             source_name = 44, priority = 108, sync_universe = 109, sequence = 111,
                             options = 112, universe = 113, dmp_length = 115, dmp_vector = 117,
                             address_type = 118, first_address = 119, address_step = 121,
                             value_count = 123, start_code = 125, levels = 126;
}  // namespace at

inline constexpr std::uint8_t kPreview = 0x80, kTerminated = 0x40, kForceSync = 0x20;
inline constexpr std::array<std::uint8_t, 12> kIdentifier{'A', 'S', 'C', '-', 'E', '1',
                                                          '.', '1', '7', 0,   0,   0};

/// What the start code of a data packet means to lamps: levels, or a priority for each address.
inline constexpr std::uint8_t kLevels = 0x00, kAddressPriorities = 0xdd;
inline constexpr std::uint16_t kDiscoveryUniverse = 64214;
/// A universe discovery page lists at most so many universes (E1.31 8.5).
inline constexpr std::size_t kPageUniverses = 512, kSyncSize = 49, kPageHead = 120;

using Cid = std::array<std::uint8_t, 16>;
using Packet = std::array<std::uint8_t, kPacketSize>;

constexpr void put16(std::span<std::uint8_t> bytes, std::size_t where, std::size_t value) {
  bytes[where] = static_cast<std::uint8_t>(value >> 8u & 0xffu);
  bytes[where + 1] = static_cast<std::uint8_t>(value & 0xffu);
}
constexpr std::uint16_t get16(std::span<const std::uint8_t> bytes, std::size_t where) {
  return static_cast<std::uint16_t>(bytes[where] << 8u | bytes[where + 1]);
}

/// What stays the same for the life of a universe's stream.
struct Stream {
  Cid cid{};
  std::string_view source_name;  ///< UTF-8; cut to 63 bytes so that a NUL always follows
  std::uint8_t priority = kDefaultPriority;
  std::uint16_t universe = 1;
  std::uint16_t sync_universe = 0;  ///< 0 = not synchronised
};

/// A whole packet of 512 zero levels, sequence 0, no option set. Each length counts from its own
/// field to the packet's end, under the flags 0x7 (E1.31 5.4, 6.1, 7.1).
constexpr Packet data_packet(const Stream& stream) {
  Packet p{};
  put16(p, at::preamble, 0x0010);
  std::copy(kIdentifier.begin(), kIdentifier.end(), p.begin() + at::identifier);
  put16(p, at::root_length, 0x7000 | (kPacketSize - at::root_length));
  p[at::root_vector + 3] = 0x04;
  std::copy(stream.cid.begin(), stream.cid.end(), p.begin() + at::cid);
  put16(p, at::framing_length, 0x7000 | (kPacketSize - at::framing_length));
  p[at::framing_vector + 3] = 0x02;
  const std::size_t name = std::min(stream.source_name.size(), kSourceNameSize - 1);
  for (std::size_t i = 0; i < name; ++i)
    p[at::source_name + i] = static_cast<std::uint8_t>(stream.source_name[i]);
  p[at::priority] = stream.priority;
  put16(p, at::sync_universe, stream.sync_universe);
  put16(p, at::universe, stream.universe);
  put16(p, at::dmp_length, 0x7000 | (kPacketSize - at::dmp_length));
  p[at::dmp_vector] = 0x02;
  p[at::address_type] = 0xa1;
  put16(p, at::address_step, 1);
  put16(p, at::value_count, 1 + kSlots);
  return p;
}

/// Patches what changes from frame to frame. Real-time.
constexpr void set_frame(Packet& packet, std::uint8_t sequence, std::uint8_t options,
                         std::span<const std::uint8_t, kSlots> levels) {
  packet[at::sequence] = sequence;
  packet[at::options] = options;
  std::copy(levels.begin(), levels.end(), packet.begin() + at::levels);
}

/// "Show now what you have heard for this synchronisation universe" (E1.31 table 4-2).
using SyncPacket = std::array<std::uint8_t, kSyncSize>;
namespace sync_at {
inline constexpr std::size_t sequence = 44, universe = 45;
}
SyncPacket sync_packet(const Cid& cid, std::uint16_t sync_universe);

/// One page of universe discovery (E1.31 table 4-3). Precondition: at most kPageUniverses, sorted.
std::vector<std::uint8_t> discovery_page(const Stream& stream, std::uint8_t page,
                                         std::uint8_t last_page,
                                         std::span<const std::uint16_t> universes);
/// All pages of a source, in order; one empty page for a source without universes.
std::vector<std::vector<std::uint8_t>> discovery_pages(const Stream& stream,
                                                       std::span<const std::uint16_t> universes);

/// A synchronisation packet as received.
struct HeardSync {
  Cid cid{};
  std::uint8_t sequence = 0;
  std::uint16_t universe = 0;
};
/// Nothing when the datagram is something else. Real-time.
std::optional<HeardSync> parse_sync(std::span<const std::uint8_t> datagram);

/// A universe discovery page as received.
struct HeardPage {
  Cid cid{};
  std::string source_name;
  std::uint8_t page = 0, last_page = 0;
  std::vector<std::uint16_t> universes;
};
std::optional<HeardPage> parse_discovery(std::span<const std::uint8_t> datagram);

/// A data packet as received; views into the datagram.
struct DataPacket {
  Cid cid{};
  std::string_view source_name;
  std::uint8_t priority = 0;
  std::uint16_t sync_universe = 0;
  std::uint8_t sequence = 0;
  bool preview = false, terminated = false, force_sync = false;
  std::uint16_t universe = 0;
  std::uint8_t start_code = 0;
  std::span<const std::uint8_t> levels;  ///< 0..512 of them; [0] is slot 1
};

/// Why a datagram is not a data packet that a node may act on.
enum class Refusal {
  none,
  too_short,       ///< not even a header
  not_acn,         ///< preamble or packet identifier
  other_vector,    ///< a sync or discovery packet, or something newer
  wrong_length,    ///< a length field disagrees with the datagram
  wrong_property,  ///< DMP address type, first address, step or count
  wrong_universe,  ///< 0 or above 63999
  wrong_priority   ///< above 200
};
std::string_view name_of(Refusal refusal);

/// Reads one datagram. Real-time; never reads beyond `datagram`.
std::optional<DataPacket> parse(std::span<const std::uint8_t> datagram, Refusal* why = nullptr);

/// Whether a packet with `next` may follow one with `last`: discard when -20 < next - last <= 0,
/// the difference taken as a signed 8-bit number (E1.31 6.7.2), so that 255 -> 0 goes on and
/// 5 -> 250 is late.
constexpr bool in_sequence(std::uint8_t last, std::uint8_t next) {
  const auto step = static_cast<std::int8_t>(static_cast<std::uint8_t>(next - last));
  return step > 0 || step <= -20;
}

/// "239.255.hi.lo" of a universe.
std::string multicast_group(std::uint16_t universe);

}  // namespace chiaro::drivers::sacn
