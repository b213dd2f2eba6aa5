// SPDX-License-Identifier: Apache-2.0
#include "simulator/virtual_studio/node.h"

#include <algorithm>
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
  if (const auto opened = node.open_sacn(studio, network); !opened) return opened.problems();
  if (const auto opened = node.open_artnet(studio, network); !opened) return opened.problems();
  return node;
}

core::Result<core::Done> Node::open_artnet(const studio::Studio& studio, ports::Network& network) {
  std::map<std::string, std::pair<std::vector<int>, std::vector<std::size_t>>> by_interface;
  const auto universes = plan_.universes();
  for (const auto& output : studio.outputs)
    if (const auto* artnet = std::get_if<studio::ArtNetOutput>(&output.driver)) {
      auto& [addresses, frames] = by_interface[artnet->interface];
      addresses.push_back(artnet->port_address >= 0 ? artnet->port_address : output.universe - 1);
      frames.push_back(static_cast<std::size_t>(
          std::lower_bound(universes.begin(), universes.end(), output.universe) -
          universes.begin()));
    }
  for (auto& [interface, ports] : by_interface) {
    const auto address = network.address_of(interface);
    if (!address)
      return core::Problem{{},
                           "the network interface '" + interface + "' has no IPv4 address",
                           "`ip address` lists them"};
    ports::Network::Options options;
    options.interface = interface;
    options.local_port = drivers::artnet::kPort;
    options.share_port = true;
    options.broadcast = true;
    auto socket = network.open_datagram(options);
    if (!socket) return socket.problems();
    drivers::artnet::Node::Identity identity;
    identity.ip = drivers::artnet::bytes_of(address->own).value_or(identity.ip);
    identity.mac = address->mac;
    identity.name = "Chiaro lamps";
    artnet_.push_back(
        {std::move(*socket), drivers::artnet::Node(ports.first, identity), ports.second});
  }
  return core::Done{};
}

core::Result<core::Done> Node::open_sacn(const studio::Studio& studio, ports::Network& network) {
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
    sockets_.push_back(std::move(*socket));
  }
  return core::Done{};
}

void Node::listen_to_artnet(ports::TimePoint now) {
  std::array<std::uint8_t, 1024> datagram;
  ports::Endpoint from;
  for (ArtNet& one : artnet_) {
    while (const auto size = one.socket->receive(datagram, &from)) {
      const auto heard = one.node.hear(std::span(datagram).first(*size), from, now);
      packets_ += heard == drivers::artnet::Node::Heard::levels;
      out_of_sequence_ += heard == drivers::artnet::Node::Heard::out_of_sequence;
      heard_ = heard_ || heard == drivers::artnet::Node::Heard::levels;
    }
    for (const auto& answer : one.node.answers(now)) one.socket->send(answer.to, answer.bytes);
  }
}

void Node::listen(ports::TimePoint now) {
  listen_to_artnet(now);
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
  for (ArtNet& one : artnet_)
    for (std::size_t i = 0; i < one.frames.size(); ++i)
      frames_[one.frames[i]].levels = one.node.levels(i, now);
  std::vector<core::FixtureState> result(plan_.fixtures());
  plan_.decode(frames_, result);
  return result;
}

std::vector<Node::Report> Node::report() const {
  std::vector<Report> result;
  for (std::size_t i = 0; i < receiver_.universes(); ++i) {
    Report one{plan_.universes()[i], {}};
    for (const auto& source : receiver_.sources(i)) one.sources.push_back(source.name);
    for (const ArtNet& artnet : artnet_)
      for (std::size_t port = 0; port < artnet.frames.size(); ++port)
        if (artnet.frames[port] == i)
          for (auto& name : artnet.node.sources(port)) one.sources.push_back(std::move(name));
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace chiaro::simulator
