// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/node.h"

#include <array>
#include <map>
#include <variant>

namespace chiaro::simulator {
namespace {

using drivers::sacn::Receiver;

/// Which universes are spoken on which interface.
std::map<std::string, std::vector<std::uint16_t>> by_interface(const studio::Studio& studio) {
  std::map<std::string, std::vector<std::uint16_t>> result;
  for (const auto& output : studio.outputs)
    if (const auto* sacn = std::get_if<studio::SacnOutput>(&output.driver))
      result[sacn->interface].push_back(output.universe);
  return result;
}

}  // namespace

Node::Node(patch::Plan plan)
    : plan_(std::move(plan)),
      receiver_({plan_.universes().begin(), plan_.universes().end()}),
      frames_(plan_.blank_frames()) {}

core::Result<Node> Node::open(const studio::Studio& studio, ports::Network& network) {
  Node node(patch::Plan::of(studio));
  for (const auto& [interface, universes] : by_interface(studio)) {
    ports::Network::Options options;
    options.interface = interface;
    options.local_port = drivers::sacn::kPort;
    options.share_port = true;
    auto socket = network.open_datagram(options);
    if (!socket) return socket.problems();
    for (const auto universe : universes)
      if (const auto joined = (*socket)->join(drivers::sacn::multicast_group(universe)); !joined)
        return joined.problems();
    node.sockets_.push_back(std::move(*socket));
  }
  return node;
}

void Node::listen(ports::TimePoint now) {
  std::array<std::uint8_t, 2048> datagram;
  for (const auto& socket : sockets_) {
    while (const auto size = socket->receive(datagram, nullptr)) {
      const auto heard = receiver_.hear(std::span(datagram).first(*size), now);
      packets_ += heard == Receiver::Heard::levels;
      out_of_sequence_ += heard == Receiver::Heard::out_of_sequence;
      heard_ = heard_ || heard == Receiver::Heard::levels;
    }
  }
}

std::vector<core::FixtureState> Node::levels(ports::TimePoint now) {
  for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i] = receiver_.frame(i, now);
  std::vector<core::FixtureState> result(plan_.fixtures());
  plan_.decode(frames_, result);
  return result;
}

std::vector<Node::Report> Node::report() const {
  std::vector<Report> result;
  for (std::size_t i = 0; i < receiver_.universes(); ++i) {
    Report one{plan_.universes()[i], {}};
    for (const auto& source : receiver_.sources(i)) one.sources.push_back(source.name);
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace chiaro::simulator
