// SPDX-License-Identifier: Apache-2.0
// Universes handed to a running olad, for the many devices that it knows and we do not.
#include "drivers/registry.h"

namespace chiaro::drivers::ola {
namespace {

class OlaPort final : public ports::OutputPort {
 public:
  OlaPort(const OutputSettings& settings, Surroundings& around)
      : universe_(settings.ola_universe != 0 ? settings.ola_universe : settings.universe),
        around_(around) {}

  core::Result<core::Done> open() override {
    stream_.reset();
    auto stream = around_.devices.open_ola();
    if (!stream) return stream.problems();
    stream_ = std::move(*stream);
    if (was_lost_) ++report_.reconnects;
    was_lost_ = false;
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint) override {
    if (!stream_) return;
    if (stream_->send(universe_, frame.levels)) {
      ++report_.frames_sent;
      return;
    }
    ++report_.frames_failed;
    stream_.reset();
    was_lost_ = true;
    report_.health = ports::PortHealth::lost;
  }

  void release(ports::TimePoint) override {
    stream_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }
  bool blocks() const override { return true; }

 private:
  const std::uint16_t universe_;
  Surroundings& around_;
  std::unique_ptr<ports::DmxStream> stream_;
  bool was_lost_ = false;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<OlaPort>(settings, around);
}

}  // namespace chiaro::drivers::ola
