// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/artnet_controller.h"

#include <algorithm>

namespace chiaro::drivers::artnet {

Controller::Controller(ports::Network& network, std::string interface)
    : network_(network), interface_(std::move(interface)) {
  // A dotted address has at most 15 letters: within what a string holds without allocating, but
  // that is the library's business, so room is made now.
  for (Node& node : nodes_) node.at.address.reserve(16);
  for (ports::Endpoint& one : found_) one.address.reserve(16);
}

core::Result<core::Done> Controller::open() {
  if (socket_) return core::Done{};
  const auto address = network_.address_of(interface_);
  if (!address)
    return core::Problem{{},
                         "the network interface '" + interface_ + "' has no IPv4 address",
                         "`ip address` lists them"};
  ports::Network::Options options;
  options.interface = interface_;
  options.local_port = kPort;
  options.share_port = true;
  options.broadcast = true;
  auto socket = network_.open_datagram(options);
  if (!socket) return socket.problems();
  socket_ = std::move(*socket);
  everybody_ = {address->broadcast, kPort};
  own_ = address->own;
  return core::Done{};
}

bool Controller::send(const ports::Endpoint& to, std::span<const std::uint8_t> datagram) {
  return socket_ && socket_->send(to, datagram);
}

void Controller::hear(ports::TimePoint now) {
  if (!socket_ || now == heard_) return;  // another port of this frame has been here
  heard_ = now;
  if (now >= next_poll_) {
    next_poll_ = now + kPollPeriod;
    socket_->send(everybody_, poll_packet());
  }
  std::array<std::uint8_t, 1024> datagram;
  ports::Endpoint from;
  for (int i = 0; i < kMostAtOnce; ++i) {
    const auto size = socket_->receive(datagram, &from);
    if (!size) break;
    if (const auto reply = parse_reply(std::span(datagram).first(*size))) take(*reply, from, now);
  }
}

void Controller::take(const HeardReply& reply, const ports::Endpoint& from, ports::TimePoint now) {
  const auto end = nodes_.begin() + static_cast<std::ptrdiff_t>(known_);
  auto node = std::find_if(nodes_.begin(), end, [&](const Node& one) {
    return one.reply.ip == reply.ip && one.reply.bind_index == reply.bind_index;
  });
  if (node == end) {
    // A full table gives up whom it has not heard for longest.
    node = known_ < nodes_.size()
               ? end
               : std::min_element(nodes_.begin(), end,
                                  [](const Node& a, const Node& b) { return a.heard < b.heard; });
    if (node == end) ++known_;
  }
  node->reply = reply;
  // Where it answered from counts: the address within may be one that is not routed here.
  node->at.address = from.address;
  node->at.port = kPort;
  node->heard = now;
}

std::span<const ports::Endpoint> Controller::subscribers(int port_address, ports::TimePoint now) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < known_; ++i) {
    const Node& node = nodes_[i];
    if (now - node.heard > kGone) continue;
    const auto first = node.reply.port_addresses.begin();
    const auto last = first + static_cast<std::ptrdiff_t>(node.reply.outputs);
    if (std::find(first, last, port_address) == last) continue;
    const auto end = found_.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(found_.begin(), end, node.at) != end) continue;  // another bind of one box
    if (count == kMostUnicast) {
      found_[0] = everybody_;
      return {found_.data(), 1};
    }
    found_[count++] = node.at;
  }
  return {found_.data(), count};
}

}  // namespace chiaro::drivers::artnet
