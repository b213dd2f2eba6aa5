// SPDX-License-Identifier: Apache-2.0
// An FTDI chip alone (Enttec Open DMX and clones): this computer makes every break and every frame,
// so the timing is as good as its scheduler and its USB: best effort, and the report says how good.
#include <algorithm>

#include "drivers/registry.h"

namespace chiaro::drivers::opendmx {
namespace {

using namespace std::chrono_literals;
constexpr ports::Duration kSlotTime = 44us;

class OpenDmxPort final : public ports::OutputPort {
 public:
  OpenDmxPort(const OutputSettings& settings, Surroundings& around)
      : settings_(settings),
        around_(around),
        slots_(static_cast<std::size_t>(std::clamp(settings.slots, 24, 512))) {}

  core::Result<core::Done> open() override {
    line_.reset();
    auto line = around_.devices.open_serial(settings_.device, {250000, 8, 2, 'N'});
    if (!line) return line.problems();
    line_ = std::move(*line);
    if (was_lost_) ++report_.reconnects;
    was_lost_ = false;
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint) override {
    if (!line_) return;
    // The chip's buffer must be empty first: a break would cut the last slots off.
    if (wait_for_the_wire() && begin() && pause(settings_.break_us) && line_->set_break(false) &&
        pause(settings_.mab_us) && write(frame)) {
      ++report_.frames_sent;
      return;
    }
    ++report_.frames_failed;
    line_.reset();
    was_lost_ = true;
    report_.health = ports::PortHealth::lost;
  }

  void release(ports::TimePoint) override {
    line_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }
  bool blocks() const override { return true; }

 private:
  bool wait_for_the_wire() {
    if (!line_->drain()) return false;
    // "Empty" is what the chip said a latency ago; the wire itself needs so long for a frame.
    if (around_.clock.now() < wire_free_) around_.clock.sleep_until(wire_free_);
    return true;
  }
  bool begin() {
    report_.left = around_.clock.now();
    return line_->set_break(true);
  }
  bool pause(int us) {
    around_.clock.sleep_until(around_.clock.now() + std::chrono::microseconds(us));
    return true;
  }
  bool write(const ports::DmxFrame& frame) {
    std::array<std::uint8_t, 1 + ports::kSlots> bytes{};  // the start code comes first
    std::copy_n(frame.levels.begin(), slots_, bytes.begin() + 1);
    const bool written = line_->write(std::span(bytes).first(1 + slots_));
    wire_free_ = around_.clock.now() + kSlotTime * (1 + slots_);
    return written;
  }

  const OutputSettings settings_;
  Surroundings& around_;
  const std::size_t slots_;
  std::unique_ptr<ports::SerialPort> line_;
  ports::TimePoint wire_free_;
  bool was_lost_ = false;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<OpenDmxPort>(settings, around);
}

}  // namespace chiaro::drivers::opendmx
