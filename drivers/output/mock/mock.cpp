// SPDX-License-Identifier: Apache-2.0
// An output that goes nowhere: what a dry run opens in place of every physical port.
#include "drivers/registry.h"

namespace chiaro::drivers::mock {
namespace {

class MockPort final : public ports::OutputPort {
 public:
  core::Result<core::Done> open() override {
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }
  void send(const ports::DmxFrame&, ports::TimePoint) override {
    if (report_.health == ports::PortHealth::good) ++report_.frames_sent;
  }
  void release(ports::TimePoint) override { report_.health = ports::PortHealth::closed; }
  ports::PortReport report() const override { return report_; }
  bool physical() const override { return false; }

 private:
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&) {
  return std::make_unique<MockPort>();
}

}  // namespace chiaro::drivers::mock
