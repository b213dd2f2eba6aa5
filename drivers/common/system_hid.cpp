// SPDX-License-Identifier: Apache-2.0
// HID surfaces by hidapi over hidraw: the kernel's own driver stays where it is.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_HID
#include <hidapi/hidapi.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_HID
namespace {

class Hid final : public ports::HidDevice {
 public:
  explicit Hid(hid_device* device) : device_(device) {}
  ~Hid() override { hid_close(device_); }
  Hid(const Hid&) = delete;
  Hid& operator=(const Hid&) = delete;
  std::optional<std::size_t> read(std::span<std::uint8_t> into, ports::Duration timeout) override {
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    const int got = hid_read_timeout(device_, into.data(), into.size(), static_cast<int>(wait));
    if (got < 0) return std::nullopt;
    return static_cast<std::size_t>(got);
  }
  bool write(std::span<const std::uint8_t> report) override {
    return hid_write(device_, report.data(), report.size()) >= 0;
  }

 private:
  hid_device* const device_;
};

}  // namespace

core::Result<std::unique_ptr<ports::HidDevice>> SystemDevices::open_hid(
    const ports::DeviceMatch& match) {
  const auto chosen = ports::choose(match, hid());
  if (!chosen) return chosen.problems();
  if (hid_init() == 0)
    if (hid_device* device = hid_open_path(chosen->identity.node.c_str()))
      return std::unique_ptr<ports::HidDevice>(std::make_unique<Hid>(device));
  return core::Problem{
      {}, "cannot open " + to_string(chosen->identity), "`chiaro doctor` checks who may use it"};
}
#else
core::Result<std::unique_ptr<ports::HidDevice>> SystemDevices::open_hid(
    const ports::DeviceMatch& match) {
  return built_without("hidapi", to_string(match), "libhidapi-dev");
}
#endif
}  // namespace chiaro::drivers
