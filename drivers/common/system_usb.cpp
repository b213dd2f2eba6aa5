// SPDX-License-Identifier: Apache-2.0
// USB devices that are spoken to by control transfers, by libusb.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_USB
#include <libusb.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_USB
namespace {

struct Closer {
  void operator()(libusb_context* context) const { libusb_exit(context); }
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using Context = std::unique_ptr<libusb_context, Closer>;
using Handle = std::unique_ptr<libusb_device_handle, Closer>;

class ControlDevice final : public ports::UsbDevice {
 public:
  ControlDevice(Context context, Handle handle)
      : context_(std::move(context)), handle_(std::move(handle)) {}
  Outcome control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                      std::span<const std::uint8_t> data, ports::Duration timeout) override {
    std::vector<std::uint8_t> copy(data.begin(), data.end());  // the library takes no const
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    const int done = libusb_control_transfer(
        handle_.get(),
        static_cast<std::uint8_t>(static_cast<int>(LIBUSB_REQUEST_TYPE_VENDOR) |
                                  static_cast<int>(LIBUSB_RECIPIENT_DEVICE) |
                                  static_cast<int>(LIBUSB_ENDPOINT_OUT)),
        request, value, index, copy.data(), static_cast<std::uint16_t>(copy.size()),
        static_cast<unsigned>(wait));
    if (done >= 0) return Outcome::done;
    if (done == LIBUSB_ERROR_PIPE) return Outcome::stalled;
    if (done == LIBUSB_ERROR_TIMEOUT) return Outcome::timed_out;
    return Outcome::gone;
  }

 private:
  Context context_;
  Handle handle_;  // closed before its context
};

std::string path_of(libusb_device* device) {
  std::string path = std::to_string(libusb_get_bus_number(device));
  std::array<std::uint8_t, 8> sockets{};
  const int depth =
      libusb_get_port_numbers(device, sockets.data(), static_cast<int>(sockets.size()));
  for (int i = 0; i < depth; ++i)
    path += (i == 0 ? "-" : ".") + std::to_string(sockets[static_cast<std::size_t>(i)]);
  return path;
}

}  // namespace

core::Result<std::unique_ptr<ports::UsbDevice>> SystemDevices::open_usb(
    const ports::DeviceMatch& match) {
  const auto chosen = ports::choose(match, usb());
  if (!chosen) return chosen.problems();
  const auto refuse = [&](const std::string& what) {
    return core::Problem{{},
                         "cannot open " + to_string(chosen->identity) + ": " + what,
                         "`chiaro doctor` checks who may use it"};
  };
  if (!chosen->kernel_driver.empty() && chosen->kernel_driver != "usbfs")
    return refuse("the kernel's driver '" + chosen->kernel_driver + "' holds it");
  libusb_context* raw = nullptr;
  if (const int code = libusb_init(&raw); code != 0) return refuse(libusb_strerror(code));
  Context context(raw);
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(raw, &list);
  libusb_device_handle* handle = nullptr;
  int code = LIBUSB_ERROR_NO_DEVICE;
  for (ssize_t i = 0; i < count; ++i)
    if (path_of(list[i]) == chosen->identity.usb_path) code = libusb_open(list[i], &handle);
  if (count >= 0) libusb_free_device_list(list, 1);
  if (handle == nullptr) return refuse(libusb_strerror(code));
  return std::unique_ptr<ports::UsbDevice>(
      std::make_unique<ControlDevice>(std::move(context), Handle(handle)));
}
#else
core::Result<std::unique_ptr<ports::UsbDevice>> SystemDevices::open_usb(
    const ports::DeviceMatch& match) {
  return built_without("libusb", to_string(match), "libusb-1.0-0-dev");
}
#endif
}  // namespace chiaro::drivers
