// SPDX-License-Identifier: Apache-2.0
// HID surfaces: what changed between two input reports is what moved; lamps are bits of one output
// report.
#include <algorithm>
#include <array>

#include "drivers/registry.h"

namespace chiaro::drivers::hid {
namespace {

using Kind = SurfaceControl::Kind;

class HidSurface final : public ports::Surface {
 public:
  HidSurface(const SurfaceSettings& settings, Surroundings& around)
      : settings_(settings),
        around_(around),
        lamps_(static_cast<std::size_t>(std::max(0, settings.report_size))) {
    if (!lamps_.empty()) lamps_[0] = settings.report_number;
  }

  core::Result<core::Done> open() override {
    device_.reset();
    auto device = around_.devices.open_hid(settings_.device);
    if (!device) return device.problems();
    device_ = std::move(*device);
    last_.fill(0);
    known_ = false;
    if (!lamps_.empty() && !device_->write(lamps_)) {  // as they were before it was lost
      device_.reset();
      return core::Problem{{}, to_string(settings_.device) + " went away", "plug it in again"};
    }
    health_ = ports::PortHealth::good;
    return core::Done{};
  }

  std::vector<ports::SurfaceEvent> listen(ports::TimePoint) override {
    std::vector<ports::SurfaceEvent> events;
    while (device_) {
      std::array<std::uint8_t, 64> report{};
      const auto size = device_->read(report, {});
      if (!size) return lose(), events;
      if (*size == 0) break;
      compare(report, events);
      last_ = report;
      known_ = true;
    }
    return events;
  }

  void show(const std::string& name, double value, const std::string&) override {
    for (const SurfaceControl& control : settings_.controls) {
      const auto byte = static_cast<std::size_t>(control.lamp_byte);
      if (control.name != name || control.lamp_byte < 0 || byte >= lamps_.size()) continue;
      const auto bit = static_cast<std::uint8_t>(1u << static_cast<unsigned>(control.lamp_bit));
      const std::uint8_t before = lamps_[byte];
      lamps_[byte] = static_cast<std::uint8_t>(value > 0 ? before | bit : before & ~bit);
      if (lamps_[byte] != before && device_ && !device_->write(lamps_)) lose();
    }
  }
  ports::PortHealth health() const override { return health_; }

 private:
  using Report = std::array<std::uint8_t, 64>;
  /// The control's raw value in a report; nothing when it lies outside.
  static std::optional<int> raw(const SurfaceControl& control, const Report& report) {
    if (control.byte < 0 || control.byte + control.bytes > static_cast<int>(report.size()))
      return std::nullopt;
    const auto at = static_cast<std::size_t>(control.byte);
    if (control.kind == Kind::button) return report[at] >> control.bit & 1;
    if (control.kind == Kind::encoder) return static_cast<std::int8_t>(report[at]);
    return control.bytes == 2 ? report[at] | report[at + 1] << 8 : report[at];
  }
  void compare(const Report& report, std::vector<ports::SurfaceEvent>& events) const {
    for (const SurfaceControl& control : settings_.controls) {
      const auto now = raw(control, report), before = raw(control, last_);
      if (!now) continue;
      if (control.kind == Kind::encoder) {
        if (*now != 0) events.push_back({control.name, static_cast<double>(*now)});
        continue;
      }
      // A fader says where it stands with the first report; a button that is held down then is one
      // that somebody wants pressed.
      const bool moved = *now != *before || (!known_ && control.kind == Kind::fader);
      if (!moved) continue;
      events.push_back(
          {control.name, control.kind == Kind::button
                             ? *now
                             : std::clamp(*now / static_cast<double>(control.most), 0.0, 1.0)});
    }
  }
  void lose() {
    device_.reset();
    health_ = ports::PortHealth::lost;
  }

  const SurfaceSettings settings_;
  Surroundings& around_;
  std::unique_ptr<ports::HidDevice> device_;
  Report last_{};
  bool known_ = false;
  std::vector<std::uint8_t> lamps_;
  ports::PortHealth health_ = ports::PortHealth::closed;
};

}  // namespace

std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&);
std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings& settings,
                                             Surroundings& around) {
  return std::make_unique<HidSurface>(settings, around);
}

}  // namespace chiaro::drivers::hid
