// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/sacn_packet.h"

namespace chiaro::drivers::sacn {
namespace {

bool length_fits(std::span<const std::uint8_t> bytes, std::size_t where) {
  const std::uint16_t field = get16(bytes, where);
  return (field & 0xf000u) == 0x7000u && (field & 0x0fffu) == bytes.size() - where;
}

bool vector_is(std::span<const std::uint8_t> bytes, std::size_t where, std::uint8_t value) {
  return bytes[where] == 0 && bytes[where + 1] == 0 && bytes[where + 2] == 0 &&
         bytes[where + 3] == value;
}

bool is_acn(std::span<const std::uint8_t> bytes) {
  return get16(bytes, at::preamble) == 0x0010 && get16(bytes, at::postamble) == 0 &&
         std::equal(kIdentifier.begin(), kIdentifier.end(), bytes.begin() + at::identifier);
}

Refusal judge(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < at::framing_length) return Refusal::too_short;
  if (!is_acn(bytes)) return Refusal::not_acn;
  if (!vector_is(bytes, at::root_vector, 0x04)) return Refusal::other_vector;
  if (bytes.size() < at::levels) return Refusal::too_short;
  if (!vector_is(bytes, at::framing_vector, 0x02) || bytes[at::dmp_vector] != 0x02)
    return Refusal::other_vector;
  if (bytes.size() > kPacketSize || !length_fits(bytes, at::root_length) ||
      !length_fits(bytes, at::framing_length) || !length_fits(bytes, at::dmp_length))
    return Refusal::wrong_length;
  if (bytes[at::address_type] != 0xa1 || get16(bytes, at::first_address) != 0 ||
      get16(bytes, at::address_step) != 1 ||
      get16(bytes, at::value_count) != bytes.size() - at::start_code)
    return Refusal::wrong_property;
  const std::uint16_t universe = get16(bytes, at::universe);
  if (universe < kLeastUniverse || universe > kMostUniverse) return Refusal::wrong_universe;
  if (bytes[at::priority] > kMostPriority) return Refusal::wrong_priority;
  return Refusal::none;
}

std::string_view name_in(std::span<const std::uint8_t> bytes) {
  const char* text = reinterpret_cast<const char*>(bytes.data() + at::source_name);
  const std::string_view field(text, kSourceNameSize);
  return field.substr(0, field.find('\0'));
}

}  // namespace

std::string_view name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "none";
    case Refusal::too_short:
      return "too short";
    case Refusal::not_acn:
      return "not ACN";
    case Refusal::other_vector:
      return "another kind of packet";
    case Refusal::wrong_length:
      return "length field disagrees with the datagram";
    case Refusal::wrong_property:
      return "wrong property range";
    case Refusal::wrong_universe:
      return "universe outside 1..63999";
    case Refusal::wrong_priority:
      return "priority above 200";
  }
  return "?";
}

std::optional<DataPacket> parse(std::span<const std::uint8_t> datagram, Refusal* why) {
  const Refusal refusal = judge(datagram);
  if (why != nullptr) *why = refusal;
  if (refusal != Refusal::none) return std::nullopt;
  DataPacket packet;
  std::copy_n(datagram.begin() + at::cid, packet.cid.size(), packet.cid.begin());
  packet.source_name = name_in(datagram);
  packet.priority = datagram[at::priority];
  packet.sync_universe = get16(datagram, at::sync_universe);
  packet.sequence = datagram[at::sequence];
  packet.preview = (datagram[at::options] & kPreview) != 0;
  packet.terminated = (datagram[at::options] & kTerminated) != 0;
  packet.force_sync = (datagram[at::options] & kForceSync) != 0;
  packet.universe = get16(datagram, at::universe);
  packet.start_code = datagram[at::start_code];
  packet.levels = datagram.subspan(at::levels);
  return packet;
}

namespace {

/// Root and framing layers of an extended packet: everything but data.
void put_extended(std::span<std::uint8_t> p, const Cid& cid, std::uint8_t framing_vector) {
  put16(p, at::preamble, 0x0010);
  std::copy(kIdentifier.begin(), kIdentifier.end(), p.begin() + at::identifier);
  put16(p, at::root_length, 0x7000 | (p.size() - at::root_length));
  p[at::root_vector + 3] = 0x08;
  std::copy(cid.begin(), cid.end(), p.begin() + at::cid);
  put16(p, at::framing_length, 0x7000 | (p.size() - at::framing_length));
  p[at::framing_vector + 3] = framing_vector;
}

bool is_extended(std::span<const std::uint8_t> bytes, std::uint8_t framing_vector) {
  return bytes.size() >= kSyncSize && is_acn(bytes) && vector_is(bytes, at::root_vector, 0x08) &&
         vector_is(bytes, at::framing_vector, framing_vector) &&
         length_fits(bytes, at::root_length) && length_fits(bytes, at::framing_length);
}

constexpr std::size_t kPageLength = 112, kPageVector = 114, kPageNumber = 118, kLastPage = 119;

}  // namespace

SyncPacket sync_packet(const Cid& cid, std::uint16_t sync_universe) {
  SyncPacket packet{};
  put_extended(packet, cid, 0x01);
  put16(packet, sync_at::universe, sync_universe);
  return packet;
}

std::vector<std::uint8_t> discovery_page(const Stream& stream, std::uint8_t page,
                                         std::uint8_t last_page,
                                         std::span<const std::uint16_t> universes) {
  std::vector<std::uint8_t> packet(kPageHead + 2 * universes.size());
  put_extended(packet, stream.cid, 0x02);
  const auto name = stream.source_name.substr(0, kSourceNameSize - 1);
  std::copy(name.begin(), name.end(), packet.begin() + at::source_name);
  put16(packet, kPageLength, 0x7000 | (packet.size() - kPageLength));
  packet[kPageVector + 3] = 0x01;
  packet[kPageNumber] = page;
  packet[kLastPage] = last_page;
  for (std::size_t i = 0; i < universes.size(); ++i) put16(packet, kPageHead + 2 * i, universes[i]);
  return packet;
}

std::vector<std::vector<std::uint8_t>> discovery_pages(const Stream& stream,
                                                       std::span<const std::uint16_t> universes) {
  std::vector<std::vector<std::uint8_t>> pages;
  const std::size_t last = universes.empty() ? 0 : (universes.size() - 1) / kPageUniverses;
  for (std::size_t page = 0; page <= last; ++page) {
    const auto rest = universes.subspan(page * kPageUniverses);
    pages.push_back(discovery_page(stream, static_cast<std::uint8_t>(page),
                                   static_cast<std::uint8_t>(last),
                                   rest.first(std::min(rest.size(), kPageUniverses))));
  }
  return pages;
}

std::optional<HeardSync> parse_sync(std::span<const std::uint8_t> datagram) {
  if (datagram.size() != kSyncSize || !is_extended(datagram, 0x01)) return std::nullopt;
  HeardSync sync;
  std::copy_n(datagram.begin() + at::cid, sync.cid.size(), sync.cid.begin());
  sync.sequence = datagram[sync_at::sequence];
  sync.universe = get16(datagram, sync_at::universe);
  return sync;
}

std::optional<HeardPage> parse_discovery(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kPageHead || datagram.size() % 2 != 0 ||
      datagram.size() > kPageHead + 2 * kPageUniverses || !is_extended(datagram, 0x02) ||
      !length_fits(datagram, kPageLength) || !vector_is(datagram, kPageVector, 0x01))
    return std::nullopt;
  HeardPage page;
  std::copy_n(datagram.begin() + at::cid, page.cid.size(), page.cid.begin());
  page.source_name = name_in(datagram);
  page.page = datagram[kPageNumber];
  page.last_page = datagram[kLastPage];
  for (std::size_t at = kPageHead; at < datagram.size(); at += 2)
    page.universes.push_back(get16(datagram, at));
  return page;
}

std::string multicast_group(std::uint16_t universe) {
  return "239.255." + std::to_string(universe >> 8u) + "." + std::to_string(universe & 0xffu);
}

}  // namespace chiaro::drivers::sacn
