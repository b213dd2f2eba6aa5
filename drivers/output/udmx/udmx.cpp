// SPDX-License-Identifier: Apache-2.0
// uDMX (anyma): a low-speed device that manages some 15 full universes a second, so only the span
// of slots that changed is sent. It goes on by itself with what it has.
#include <algorithm>

#include "drivers/registry.h"

namespace chiaro::drivers::udmx {
namespace {

using namespace std::chrono_literals;

/// The one request ever sent. Its neighbour 0xF8 would start the boot loader.
constexpr std::uint8_t kSetChannelRange = 2;
constexpr ports::Duration kTimeout = 500ms;
/// Everything again so often: a transfer may be lost without a word.
constexpr ports::Duration kRefresh = 2s;
constexpr int kMostFailures = 10;

/// The ids are V-USB's, shared by many devices: only the strings tell this one.
ports::DeviceMatch match_of(ports::DeviceMatch device) {
  device.vendor = 0x16c0;
  device.product = 0x05dc;
  device.manufacturer = "www.anyma.ch";
  device.name = "uDMX";
  return device;
}

class UdmxPort final : public ports::OutputPort {
 public:
  UdmxPort(const OutputSettings& settings, Surroundings& around)
      : match_(match_of(settings.device)),
        around_(around),
        slots_(static_cast<std::size_t>(std::clamp(settings.slots, 1, 512))) {}

  core::Result<core::Done> open() override {
    device_.reset();
    auto device = around_.devices.open_usb(match_);
    if (!device) return device.problems();
    device_ = std::move(*device);
    whole_at_ = {};
    failures_ = 0;
    if (was_lost_) ++report_.reconnects;
    was_lost_ = false;
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }

  void send(const ports::DmxFrame& frame, ports::TimePoint now) override {
    if (!device_) return;
    std::size_t first = 0, end = slots_;
    if (now < whole_at_) {
      while (first < end && frame.levels[first] == there_[first]) ++first;
      while (end > first && frame.levels[end - 1] == there_[end - 1]) --end;
    }
    if (first == end) {
      ++report_.frames_sent;  // the device has it already
      return;
    }
    const auto outcome =
        device_->control_out(kSetChannelRange, static_cast<std::uint16_t>(end - first),
                             static_cast<std::uint16_t>(first),
                             std::span(frame.levels).subspan(first, end - first), kTimeout);
    if (outcome == ports::UsbDevice::Outcome::done) {
      std::copy(frame.levels.begin(), frame.levels.end(), there_.begin());
      if (first == 0 && end == slots_) whole_at_ = now + kRefresh;
      failures_ = 0;
      ++report_.frames_sent;
      return;
    }
    fail(outcome);
  }

  void release(ports::TimePoint) override {
    device_.reset();
    report_.health = ports::PortHealth::closed;
  }

  ports::PortReport report() const override { return report_; }
  bool physical() const override { return true; }
  bool blocks() const override { return true; }

 private:
  /// A stall now and then is the firmware's way; the whole universe is sent next.
  void fail(ports::UsbDevice::Outcome outcome) {
    ++report_.frames_failed;
    whole_at_ = {};
    if (outcome != ports::UsbDevice::Outcome::gone && ++failures_ < kMostFailures) return;
    device_.reset();
    was_lost_ = true;
    report_.health = ports::PortHealth::lost;
  }

  const ports::DeviceMatch match_;
  Surroundings& around_;
  const std::size_t slots_;
  std::unique_ptr<ports::UsbDevice> device_;
  std::array<std::uint8_t, ports::kSlots> there_{};
  ports::TimePoint whole_at_;
  int failures_ = 0;
  bool was_lost_ = false;
  ports::PortReport report_;
};

}  // namespace

std::unique_ptr<ports::OutputPort> make(const OutputSettings&, Surroundings&);
std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around) {
  return std::make_unique<UdmxPort>(settings, around);
}

}  // namespace chiaro::drivers::udmx
