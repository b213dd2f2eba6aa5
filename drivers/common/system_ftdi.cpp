// SPDX-License-Identifier: Apache-2.0
// FTDI chips without a kernel driver, by libftdi. Where ftdi_sio holds the chip its tty is used
// instead: nothing is ever detached.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_FTDI
#include <ftdi.h>
#include <libusb.h>
#include <thread>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_FTDI
namespace {

class Ftdi final : public ports::SerialPort {
 public:
  Ftdi() : chip_(ftdi_new()) {
    // The library would take the kernel driver off by itself.
    if (chip_ != nullptr) chip_->module_detach_mode = DONT_DETACH_SIO_MODULE;
  }
  ~Ftdi() override {
    if (chip_ != nullptr) ftdi_free(chip_);  // closes it too
  }
  Ftdi(const Ftdi&) = delete;
  Ftdi& operator=(const Ftdi&) = delete;
  ftdi_context* chip() { return chip_; }

  bool configure(const ports::SerialSettings& settings) {
    settings_ = settings;
    chip_->usb_write_timeout = kPatienceMs;
    chip_->usb_read_timeout = kPatienceMs;
    return ftdi_usb_reset(chip_) == 0 && ftdi_set_baudrate(chip_, settings.baud) == 0 &&
           line(false) && ftdi_setflowctrl(chip_, SIO_DISABLE_FLOW_CTRL) == 0 &&
           ftdi_setrts(chip_, 0) == 0 && ftdi_tcioflush(chip_) == 0 &&
           ftdi_set_latency_timer(chip_, 2) == 0;
  }
  bool write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const int wrote = ftdi_write_data(chip_, bytes.data(), static_cast<int>(bytes.size()));
      if (wrote <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    }
    return true;
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, ports::Duration timeout) override {
    const auto end = std::chrono::steady_clock::now() + timeout;
    do {
      // The chip answers at least every latency period; a timed-out transfer is "nothing yet".
      const int got = ftdi_read_data(chip_, into.data(), static_cast<int>(into.size()));
      if (got > 0) return static_cast<std::size_t>(got);
      if (got < 0 && got != LIBUSB_ERROR_TIMEOUT) return std::nullopt;
    } while (std::chrono::steady_clock::now() < end);
    return 0;
  }
  bool set_break(bool on) override { return line(on); }
  bool drain() override {
    for (int i = 0; i < kPatienceMs; ++i) {
      unsigned short status = 0;
      if (ftdi_poll_modem_status(chip_, &status) != 0) return false;
      constexpr unsigned kTransmitterEmpty = 0x4000;
      if ((status & kTransmitterEmpty) != 0) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

 private:
  bool line(bool broken) {
    return ftdi_set_line_property2(chip_, settings_.data_bits == 7 ? BITS_7 : BITS_8,
                                   settings_.stop_bits == 2 ? STOP_BIT_2 : STOP_BIT_1,
                                   settings_.parity == 'E'   ? EVEN
                                   : settings_.parity == 'O' ? ODD
                                                             : NONE,
                                   broken ? BREAK_ON : BREAK_OFF) == 0;
  }
  static constexpr int kPatienceMs = 500;
  ftdi_context* const chip_;
  ports::SerialSettings settings_;
};

/// "1-1.4" of a libusb device, as /sys calls it.
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

core::Result<std::unique_ptr<ports::SerialPort>> open_ftdi(const ports::DeviceMatch& identity,
                                                           const ports::SerialSettings& settings) {
  auto port = std::make_unique<Ftdi>();
  const auto refuse = [&](const std::string& what) {
    return core::Problem{{},
                         "cannot open " + to_string(identity) + ": " + what,
                         "`chiaro doctor` checks who may use it"};
  };
  if (port->chip() == nullptr) return refuse("no memory");
  ftdi_device_list* list = nullptr;
  if (ftdi_usb_find_all(port->chip(), &list, identity.vendor, identity.product) < 0)
    return refuse(ftdi_get_error_string(port->chip()));
  int opened = -1;
  for (const ftdi_device_list* one = list; one != nullptr; one = one->next)
    if (path_of(one->dev) == identity.usb_path) opened = ftdi_usb_open_dev(port->chip(), one->dev);
  ftdi_list_free(&list);
  if (opened != 0 || !port->configure(settings)) return refuse(ftdi_get_error_string(port->chip()));
  return std::unique_ptr<ports::SerialPort>(std::move(port));
}
#else
core::Result<std::unique_ptr<ports::SerialPort>> open_ftdi(const ports::DeviceMatch& identity,
                                                           const ports::SerialSettings&) {
  return built_without("libftdi", to_string(identity) + ", which has no tty,", "libftdi1-dev");
}
#endif
}  // namespace chiaro::drivers
