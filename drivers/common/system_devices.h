// SPDX-License-Identifier: Apache-2.0
// Real devices behind ports::Devices. What needs a library that was missing when Chiaro was built
// answers "built without …"; what is plugged in is read from /sys at every call.
#pragma once

#include <filesystem>

#include "controller/ports/devices.h"

namespace chiaro::drivers {

class SystemDevices final : public ports::Devices {
 public:
  /// Another root than "/" is for tests: its sys/ and dev/ are read, nothing in it is opened.
  explicit SystemDevices(std::filesystem::path root = "/") : root_(std::move(root)) {}

  std::vector<ports::DeviceFound> usb() override;
  std::vector<ports::DeviceFound> hid() override;
  core::Result<std::unique_ptr<ports::SerialPort>> open_serial(
      const ports::DeviceMatch& match, const ports::SerialSettings& settings) override;
  core::Result<std::unique_ptr<ports::UsbDevice>> open_usb(
      const ports::DeviceMatch& match) override;
  core::Result<std::unique_ptr<ports::HidDevice>> open_hid(
      const ports::DeviceMatch& match) override;
  core::Result<std::unique_ptr<ports::GpioLine>> open_gpio(
      const ports::GpioSettings& settings) override;
  core::Result<std::unique_ptr<ports::MidiPort>> open_midi(const std::string& name) override;
  core::Result<std::unique_ptr<ports::ModbusLink>> open_modbus(
      const ports::ModbusLine& line) override;
  core::Result<std::unique_ptr<ports::DmxStream>> open_ola() override;

 private:
  const std::filesystem::path root_;
};

/// "built without LIBRARY: WHAT cannot be used", with the package to install.
core::Problem built_without(const std::string& library, const std::string& what,
                            const std::string& package);

/// A tty by its node, exactly as it is: raw, exclusive, any baud rate.
core::Result<std::unique_ptr<ports::SerialPort>> open_tty(const std::string& node,
                                                          const ports::SerialSettings& settings);
/// An FTDI chip that no kernel driver holds.
core::Result<std::unique_ptr<ports::SerialPort>> open_ftdi(const ports::DeviceMatch& identity,
                                                           const ports::SerialSettings& settings);

}  // namespace chiaro::drivers
