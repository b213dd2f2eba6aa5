// SPDX-License-Identifier: Apache-2.0
// One universe of sACN. Sending is one non-blocking datagram, so the output loop may call it.
#include "drivers/common/sacn_packet.h"
#include "drivers/registry.h"

namespace chiaro::drivers::sacn {
namespace {

core::Problem refusal(const std::string& what, const std::string& remedy) {
  return {{}, what, remedy, false};
}

class SacnPort final : public ports::OutputPort {
 public:
  SacnPort(const OutputSettings& settings, ports::Network& network)
      : settings_(settings),
        network_(network),
        to_{settings.unicast.empty() ? multicast_group(settings.universe) : settings.unicast,
            kPort},
        packet_(data_packet({settings.cid, settings.source_name,
                             static_cast<std::uint8_t>(settings.priority), settings.universe})) {}

  core::Result<core::Done> open() override {
    const std::string here = "sACN universe " + std::to_string(settings_.universe);
    if (settings_.universe < kLeastUniverse || settings_.universe > kMostUniverse)
      return refusal(here + " does not exist", "sACN universes are 1 to 63999");
    if (settings_.priority < 0 || settings_.priority > kMostPriority)
      return refusal(here + " has priority " + std::to_string(settings_.priority),
                     "priorities are 0 to 200; 100 is usual, the highest wins");
    ports::Network::Options options;
    options.interface = settings_.interface;
    auto socket = network_.open_datagram(options);
    if (!socket) {
      auto problems = socket.problems();
      for (auto& problem : problems) problem.what = here + ": " + problem.what;
      return problems;
    }
    socket_ = std::move(*socket);
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint) override { send(frame.levels, 0); }

  /// E1.31 6.2.6: three packets with Stream_Terminated, so that a lost one does not matter.
  void release(ports::TimePoint) override {
    std::array<std::uint8_t, kSlots> levels{};
    std::copy_n(packet_.begin() + at::levels, kSlots, levels.begin());
    for (int i = 0; i < 3; ++i) send(levels, kTerminated);
    socket_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }

 private:
  void send(std::span<const std::uint8_t, kSlots> levels, std::uint8_t options) {
    if (!socket_) return;
    set_frame(packet_, ++sequence_, options, levels);
    if (!socket_->send(to_, packet_)) {
      ++report_.frames_failed;
      report_.health = ports::PortHealth::lost;
      return;
    }
    ++report_.frames_sent;
    if (report_.health == ports::PortHealth::lost) ++report_.reconnects;
    report_.health = ports::PortHealth::good;
  }

  const OutputSettings settings_;
  ports::Network& network_;
  const ports::Endpoint to_;
  Packet packet_;
  std::uint8_t sequence_ = 0;
  std::unique_ptr<ports::DatagramSocket> socket_;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, ports::Network&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, ports::Network& network) {
  return std::make_unique<SacnPort>(settings, network);
}

}  // namespace chiaro::drivers::sacn
