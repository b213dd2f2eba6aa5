// SPDX-License-Identifier: Apache-2.0
// sACN heard from others, on one interface.
#include "drivers/common/sacn_receiver.h"
#include "drivers/registry.h"

namespace chiaro::drivers::sacn {
namespace {

class SacnInput final : public ports::DmxInput {
 public:
  SacnInput(const InputSettings& settings, ports::Network& network)
      : settings_(settings),
        network_(network),
        receiver_(settings.universes, {.per_address_priority = true, .synchronised = true}) {}

  core::Result<core::Done> open() override {
    ports::Network::Options options;
    options.interface = settings_.interface;
    options.local_port = kPort;
    options.share_port = true;
    auto socket = network_.open_datagram(options);
    if (!socket) return socket.problems();
    for (const auto universe : settings_.universes)
      if (const auto joined = (*socket)->join(multicast_group(universe)); !joined)
        return joined.problems();
    socket_ = std::move(*socket);
    return core::Done{};
  }

  std::size_t listen(ports::TimePoint now) override {
    std::size_t heard = 0;
    std::array<std::uint8_t, 2048> datagram;
    while (socket_) {
      const auto size = socket_->receive(datagram, nullptr);
      if (!size) break;
      const auto what = receiver_.hear(std::span(datagram).first(*size), now);
      heard += what == Receiver::Heard::levels;
      late_ += what == Receiver::Heard::out_of_sequence;
      // A source that is synchronised on another universe says so in its data.
      if (const std::uint16_t sync = receiver_.sync_to_join(); sync != 0)
        (void)socket_->join(multicast_group(sync));
    }
    return heard;
  }

  const ports::DmxFrame& frame(std::size_t i, ports::TimePoint now) override {
    return receiver_.frame(i, now);
  }
  std::size_t universes() const override { return receiver_.universes(); }
  std::vector<std::string> sources(std::size_t i) const override {
    std::vector<std::string> names;
    for (const auto& source : receiver_.sources(i)) names.push_back(source.name);
    return names;
  }
  std::uint64_t out_of_sequence() const override { return late_; }

 private:
  const InputSettings settings_;
  ports::Network& network_;
  Receiver receiver_;
  std::unique_ptr<ports::DatagramSocket> socket_;
  std::uint64_t late_ = 0;
};

}  // namespace

std::unique_ptr<ports::DmxInput> make_input(const InputSettings&, Surroundings&);
std::unique_ptr<ports::DmxInput> make_input(const InputSettings& settings, Surroundings& around) {
  return std::make_unique<SacnInput>(settings, around.network);
}

}  // namespace chiaro::drivers::sacn
