// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/artnet_packet.h"

#include <cstdio>
#include <cstring>

namespace chiaro::drivers::artnet {
namespace {

constexpr std::array<std::uint8_t, 8> kIdentifier{'A', 'r', 't', '-', 'N', 'e', 't', 0};

/// Where the fields of an ArtPollReply sit. It alone has no protocol version.
namespace at {
constexpr std::size_t ip = 10, port = 14, net = 18, sub_net = 19, status = 23, short_name = 26,
                      long_name = 44, report = 108, ports = 172, port_types = 174, good_input = 178,
                      good_output = 182, in = 186, out = 190, style = 200, mac = 201, bind_ip = 207,
                      bind_index = 211, status2 = 212;
}  // namespace at
constexpr std::uint8_t kOutputPort = 0x80, kInputPort = 0x40, kDmxPort = 0x00;

void begin(std::span<std::uint8_t> packet, Operation operation, bool versioned = true) {
  std::copy(kIdentifier.begin(), kIdentifier.end(), packet.begin());
  packet[8] = static_cast<std::uint8_t>(static_cast<unsigned>(operation) & 0xffu);
  packet[9] = static_cast<std::uint8_t>(static_cast<unsigned>(operation) >> 8u);
  if (versioned) packet[11] = kProtocol;
}

void put_text(std::span<std::uint8_t> packet, std::size_t where, std::size_t field,
              const std::string& text) {
  const std::size_t size = std::min(text.size(), field - 1);
  std::copy_n(text.begin(), size, packet.begin() + static_cast<std::ptrdiff_t>(where));
}

}  // namespace

DmxPacket dmx_packet(int port_address) {
  DmxPacket packet{};
  begin(packet, Operation::dmx);
  packet[14] = static_cast<std::uint8_t>(port_address & 0xff);
  packet[15] = static_cast<std::uint8_t>(port_address >> 8 & 0x7f);
  packet[16] = kSlots >> 8u;
  packet[17] = kSlots & 0xffu;
  return packet;
}

void set_frame(DmxPacket& packet, std::uint8_t sequence,
               std::span<const std::uint8_t, kSlots> levels) {
  packet[12] = sequence;
  std::copy(levels.begin(), levels.end(), packet.begin() + kDmxHead);
}

std::array<std::uint8_t, kPollSize> poll_packet() {
  std::array<std::uint8_t, kPollSize> packet{};
  begin(packet, Operation::poll);
  packet[12] = 0x02;  // tell me again whenever your patch changes
  return packet;
}

std::array<std::uint8_t, kSyncSize> sync_packet() {
  std::array<std::uint8_t, kSyncSize> packet{};
  begin(packet, Operation::sync);
  return packet;
}

std::vector<std::uint8_t> reply_packet(const Reply& reply) {
  std::vector<std::uint8_t> p(kReplySize);
  begin(p, Operation::poll_reply, false);
  const auto put = [&](std::size_t where, const auto& bytes) {
    std::copy(bytes.begin(), bytes.end(), p.begin() + static_cast<std::ptrdiff_t>(where));
  };
  put(at::ip, reply.ip);
  p[at::port] = kPort & 0xffu;
  p[at::port + 1] = kPort >> 8u;
  p[at::net] = reply.net;
  p[at::sub_net] = reply.sub_net;
  p[at::status] = 0xd0;  // indicators normal, addresses set by software
  put_text(p, at::short_name, 18, reply.short_name);
  put_text(p, at::long_name, 64, reply.long_name);
  put_text(p, at::report, 64, reply.report);
  const std::size_t ports = std::min<std::size_t>(reply.ports.size(), 4);
  p[at::ports + 1] = static_cast<std::uint8_t>(ports);
  for (std::size_t i = 0; i < ports; ++i) {
    const Reply::Port& port = reply.ports[i];
    p[at::port_types + i] = static_cast<std::uint8_t>((port.output ? kOutputPort : 0) |
                                                      (port.input ? kInputPort : 0) | kDmxPort);
    p[at::good_input + i] = port.input ? 0x80 : 0;
    p[at::good_output + i] =
        static_cast<std::uint8_t>((port.output ? 0x80 : 0) | (port.merging ? 0x08 : 0));
    p[at::in + i] = port.input ? port.universe : 0;
    p[at::out + i] = port.output ? port.universe : 0;
  }
  p[at::style] = reply.style;
  put(at::mac, reply.mac);
  put(at::bind_ip, reply.ip);
  p[at::bind_index] = reply.bind_index;
  p[at::status2] = 0x08;  // 15-bit port-addresses
  return p;
}

std::optional<Operation> operation_of(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < 12 || !std::equal(kIdentifier.begin(), kIdentifier.end(), datagram.begin()))
    return std::nullopt;
  const auto operation = static_cast<Operation>(datagram[8] | datagram[9] << 8u);
  if (operation == Operation::poll_reply) return operation;
  const int protocol = datagram[10] << 8u | datagram[11];
  return protocol >= kProtocol ? std::optional(operation) : std::nullopt;
}

std::optional<HeardDmx> parse_dmx(std::span<const std::uint8_t> datagram) {
  if (operation_of(datagram) != Operation::dmx || datagram.size() < kDmxHead) return std::nullopt;
  const std::size_t length = static_cast<std::size_t>(datagram[16] << 8u | datagram[17]);
  if (length < 2 || length > kSlots || length % 2 != 0 || datagram.size() < kDmxHead + length)
    return std::nullopt;
  if ((datagram[15] & 0x80u) != 0) return std::nullopt;
  return HeardDmx{datagram[15] << 8 | datagram[14], datagram[12],
                  datagram.subspan(kDmxHead, length)};
}

std::optional<HeardReply> parse_reply(std::span<const std::uint8_t> datagram) {
  if (operation_of(datagram) != Operation::poll_reply || datagram.size() < kLeastReply)
    return std::nullopt;
  HeardReply reply;
  std::copy_n(datagram.begin() + at::ip, 4, reply.ip.begin());
  // Older nodes stop before the bind index.
  reply.bind_index = datagram.size() > at::bind_index ? datagram[at::bind_index] : 0;
  const std::size_t ports = std::min<std::size_t>(datagram[at::ports + 1], 4);
  const int base = (datagram[at::net] & 0x7f) << 8 | (datagram[at::sub_net] & 0x0f) << 4;
  for (std::size_t i = 0; i < ports; ++i)
    if ((datagram[at::port_types + i] & kOutputPort) != 0)
      reply.port_addresses[reply.outputs++] =
          static_cast<std::uint16_t>(base | (datagram[at::out + i] & 0x0f));
  return reply;
}

std::string name_in_reply(std::span<const std::uint8_t> datagram) {
  const char* text = reinterpret_cast<const char*>(datagram.data()) + at::short_name;
  return {text, ::strnlen(text, 18)};
}

bool in_sequence(std::uint8_t last, std::uint8_t next) {
  if (last == 0 || next == 0) return true;
  const int step = (next - last + 255) % 255;  // the numbers are 1 to 255: 255 of them
  return step != 0 && step < 255 - 20;
}

std::optional<std::array<std::uint8_t, 4>> bytes_of(const std::string& text) {
  std::array<unsigned, 4> parts{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%3u.%3u.%3u.%3u%c", &parts[0], &parts[1], &parts[2], &parts[3],
                  &rest) != 4)
    return std::nullopt;
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (parts[i] > 255) return std::nullopt;
    bytes[i] = static_cast<std::uint8_t>(parts[i]);
  }
  return bytes;
}

std::string dotted(const std::array<std::uint8_t, 4>& address) {
  return std::to_string(address[0]) + "." + std::to_string(address[1]) + "." +
         std::to_string(address[2]) + "." + std::to_string(address[3]);
}

}  // namespace chiaro::drivers::artnet
