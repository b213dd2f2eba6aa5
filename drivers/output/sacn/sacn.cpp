// SPDX-License-Identifier: Apache-2.0
// One universe of sACN. Sending is one non-blocking datagram, so the output loop may call it. The
// first universe of a source also tells the network which universes there are; the last one ends
// each frame with a synchronisation packet where that is asked for.
#include "drivers/common/quiet.h"
#include "drivers/common/sacn_batch.h"
#include "drivers/common/sacn_packet.h"
#include "drivers/registry.h"

namespace chiaro::drivers::sacn {
namespace {

/// E131_UNIVERSE_DISCOVERY_INTERVAL.
constexpr ports::Duration kDiscoveryPeriod = std::chrono::seconds(10);

core::Problem refusal(const std::string& what, const std::string& remedy) {
  return {{}, what, remedy, false};
}

Stream stream_of(const OutputSettings& settings) {
  return {settings.cid, settings.source_name, static_cast<std::uint8_t>(settings.priority),
          settings.universe, settings.sync};
}

class SacnPort final : public ports::OutputPort, private Batch::Sender {
 public:
  SacnPort(const OutputSettings& settings, Surroundings& around)
      : settings_(settings),
        network_(around.network),
        batch_(
            around.shared.get<Batch>(settings.interface, [] { return std::make_shared<Batch>(); })),
        to_{settings.unicast.empty() ? multicast_group(settings.universe) : settings.unicast,
            kPort},
        sync_to_{settings.unicast.empty() ? multicast_group(settings.sync) : settings.unicast,
                 kPort},
        packet_(data_packet(stream_of(settings))),
        sync_(sync_packet(settings.cid, settings.sync)),
        quiet_(settings.quiet) {
    const auto& all = settings_.together;
    speaks_for_all_ = all.empty() || all.front() == settings.universe;
    ends_the_frame_ = settings.sync != 0 && (all.empty() || all.back() == settings.universe);
    const std::vector<std::uint16_t> alone{settings.universe};
    if (speaks_for_all_) pages_ = discovery_pages(stream_of(settings_), all.empty() ? alone : all);
  }

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

  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (!socket_) return;
    send_later(frame, now);
    flush();
  }

  void send_later(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (!socket_) return;
    if (quiet_.must_send(frame, now)) {
      set_frame(packet_, ++sequence_, 0, frame.levels);
      batch_->add(*socket_, to_, packet_, this);
    }
    if (ends_the_frame_) {
      ++sync_[sync_at::sequence];
      batch_->add(*socket_, sync_to_, sync_, nullptr);
    }
    if (speaks_for_all_ && now >= next_discovery_) {
      next_discovery_ = now + kDiscoveryPeriod;
      for (const auto& page : pages_) socket_->send(discovery_to_, page);
    }
  }

  void flush() override { batch_->flush(); }

  /// E1.31 6.2.6: three packets with Stream_Terminated, so that a lost one does not matter.
  void release(ports::TimePoint) override {
    std::array<std::uint8_t, kSlots> levels{};
    std::copy_n(packet_.begin() + at::levels, kSlots, levels.begin());
    for (int i = 0; i < 3 && socket_; ++i) {
      set_frame(packet_, ++sequence_, kTerminated, levels);
      judge(socket_->send(to_, packet_));
    }
    socket_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }

 private:
  void judge(bool sent) override {
    if (!sent) {
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
  const std::shared_ptr<Batch> batch_;
  const ports::Endpoint to_, sync_to_, discovery_to_{multicast_group(kDiscoveryUniverse), kPort};
  Packet packet_;
  SyncPacket sync_;
  Quiet quiet_;
  std::vector<std::vector<std::uint8_t>> pages_;
  bool speaks_for_all_ = false, ends_the_frame_ = false;
  ports::TimePoint next_discovery_;
  std::uint8_t sequence_ = 0;
  std::unique_ptr<ports::DatagramSocket> socket_;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<SacnPort>(settings, around);
}

}  // namespace chiaro::drivers::sacn
