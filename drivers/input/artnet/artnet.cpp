// SPDX-License-Identifier: Apache-2.0
// Art-Net heard from others, as a node on one interface. Universe 1 is port-address 0.
#include "drivers/common/artnet_node.h"
#include "drivers/registry.h"

namespace chiaro::drivers::artnet {
namespace {

class ArtNetInput final : public ports::DmxInput {
 public:
  ArtNetInput(const InputSettings& settings, ports::Network& network)
      : settings_(settings), network_(network), frames_(settings.universes.size()) {
    for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i].universe = settings.universes[i];
    become({});
  }

  core::Result<core::Done> open() override {
    const auto address = network_.address_of(settings_.interface);
    if (!address)
      return core::Problem{
          {},
          "the network interface '" + settings_.interface + "' has no IPv4 address",
          "`ip address` lists them"};
    ports::Network::Options options;
    options.interface = settings_.interface;
    options.local_port = kPort;
    options.share_port = true;
    options.broadcast = true;
    auto socket = network_.open_datagram(options);
    if (!socket) return socket.problems();
    become({bytes_of(address->own).value_or(std::array<std::uint8_t, 4>{}), address->mac,
            settings_.name});
    socket_ = std::move(*socket);
    return core::Done{};
  }

  std::size_t listen(ports::TimePoint now) override {
    std::size_t heard = 0;
    std::array<std::uint8_t, 1024> datagram;
    ports::Endpoint from;
    while (socket_) {
      const auto size = socket_->receive(datagram, &from);
      if (!size) break;
      const auto what = node_->hear(std::span(datagram).first(*size), from, now);
      heard += what == Node::Heard::levels;
      late_ += what == Node::Heard::out_of_sequence;
    }
    for (const auto& answer : node_->answers(now)) socket_->send(answer.to, answer.bytes);
    return heard;
  }

  const ports::DmxFrame& frame(std::size_t i, ports::TimePoint now) override {
    frames_[i].levels = node_->levels(i, now);
    return frames_[i];
  }
  std::size_t universes() const override { return frames_.size(); }
  std::vector<std::string> sources(std::size_t i) const override { return node_->sources(i); }
  std::uint64_t out_of_sequence() const override { return late_; }

 private:
  void become(Node::Identity identity) {
    std::vector<int> addresses;
    for (const auto universe : settings_.universes) addresses.push_back(universe - 1);
    node_.emplace(addresses, std::move(identity));
  }

  const InputSettings settings_;
  ports::Network& network_;
  std::optional<Node> node_;
  std::vector<ports::DmxFrame> frames_;
  std::unique_ptr<ports::DatagramSocket> socket_;
  std::uint64_t late_ = 0;
};

}  // namespace

std::unique_ptr<ports::DmxInput> make_input(const InputSettings&, Surroundings&);
std::unique_ptr<ports::DmxInput> make_input(const InputSettings& settings, Surroundings& around) {
  return std::make_unique<ArtNetInput>(settings, around.network);
}

}  // namespace chiaro::drivers::artnet
