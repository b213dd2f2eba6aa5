// SPDX-License-Identifier: Apache-2.0
// One universe of Art-Net 4: unicast to the nodes that asked for it, or to one address, or to
// everybody where the user says so. The last universe of a frame may end it with ArtSync.
#include "drivers/common/artnet_controller.h"
#include "drivers/common/quiet.h"
#include "drivers/registry.h"

namespace chiaro::drivers::artnet {
namespace {

class ArtNetPort final : public ports::OutputPort {
 public:
  ArtNetPort(const OutputSettings& settings, Surroundings& around)
      : settings_(settings),
        around_(around),
        port_address_(settings.port_address >= 0 ? settings.port_address : settings.universe - 1),
        one_{settings.unicast, kPort},
        packet_(dmx_packet(port_address_)),
        quiet_(settings.quiet) {
    const auto& all = settings_.together;
    ends_the_frame_ = settings.art_sync && (all.empty() || all.back() == settings.universe);
  }

  core::Result<core::Done> open() override {
    if (port_address_ > kMostPortAddress)
      return core::Problem{{},
                           "Art-Net has no port-address " + std::to_string(port_address_),
                           "they are 0 to 32767"};
    controller_ = around_.shared.get<Controller>(settings_.interface, [&] {
      return std::make_shared<Controller>(around_.network, settings_.interface);
    });
    if (auto opened = controller_->open(); !opened) {
      auto problems = opened.problems();
      for (auto& problem : problems)
        problem.what =
            "Art-Net universe " + std::to_string(settings_.universe) + ": " + problem.what;
      return problems;
    }
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (report_.health == ports::PortHealth::closed) return;
    controller_->hear(now);
    if (quiet_.must_send(frame, now)) {
      sequence_ = static_cast<std::uint8_t>(sequence_ % 255 + 1);
      set_frame(packet_, sequence_, frame.levels);
      judge(send_to_all(now));
    }
    if (ends_the_frame_) controller_->send(controller_->everybody(), sync_packet());
  }

  /// The protocol has no goodbye: nodes hold, as their owner has set them.
  void release(ports::TimePoint) override {
    controller_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }

 private:
  bool send_to_all(ports::TimePoint now) {
    if (!settings_.unicast.empty()) return controller_->send(one_, packet_);
    if (settings_.broadcast) return controller_->send(controller_->everybody(), packet_);
    bool all = true;
    for (const auto& to : controller_->subscribers(port_address_, now))
      all = controller_->send(to, packet_) && all;
    return all;
  }
  void judge(bool sent) {
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
  Surroundings& around_;
  const int port_address_;
  const ports::Endpoint one_;
  DmxPacket packet_;
  Quiet quiet_;
  bool ends_the_frame_ = false;
  std::uint8_t sequence_ = 0;
  std::shared_ptr<Controller> controller_;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<ArtNetPort>(settings, around);
}

}  // namespace chiaro::drivers::artnet
