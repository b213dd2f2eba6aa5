// SPDX-License-Identifier: Apache-2.0
// Things on wires other than the network, as drivers need them. The real ones are in
// drivers/common; tests plug fake ones in and out. Nothing is opened that was not asked for by
// name, and no other program's (or the kernel's) hold on a device is ever taken away.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::ports {

/// Which device is meant. Empty fields match anything; all that are given must match. A device node
/// alone ("/dev/ttyUSB0") is enough for a serial line.
struct DeviceMatch {
  std::string node{};                     ///< "/dev/ttyUSB0", "/dev/hidraw2"
  std::uint16_t vendor = 0, product = 0;  ///< USB ids; 0 = any
  std::string serial{};                   ///< as the device says it
  std::string usb_path{};  ///< "1-1.4": the socket it sits in, for clones without serial
  std::string manufacturer{}, name{};  ///< USB strings, compared whole
  friend bool operator==(const DeviceMatch&, const DeviceMatch&) = default;
};
/// "0403:6001 serial AL01" or the node: for messages.
std::string to_string(const DeviceMatch& match);

/// A device that is there now.
struct DeviceFound {
  DeviceMatch identity;  ///< every field that is known; `node` is its tty or hidraw, if it has one
  std::string kernel_driver;  ///< "ftdi_sio"; empty = no driver holds it
};
/// Whether every field that `wanted` gives is as found.
bool matches(const DeviceMatch& wanted, const DeviceMatch& found);

struct SerialSettings {
  int baud = 250000, data_bits = 8, stop_bits = 2;
  char parity = 'N';
};

/// One serial line, tty or FTDI chip. One thread at a time. Once a call has said that the line is
/// gone (false or nullopt) it stays gone: open it again.
class SerialPort {
 public:
  virtual ~SerialPort() = default;
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
  /// Bytes that came within `timeout`, as many as there are; 0 = none came.
  virtual std::optional<std::size_t> read(std::span<std::uint8_t> into, Duration timeout) = 0;
  virtual bool set_break(bool on) = 0;
  /// Waits until the last written bit has left the chip, as far as it can tell.
  virtual bool drain() = 0;
};

/// A USB device that is spoken to by control transfers. One thread at a time.
class UsbDevice {
 public:
  enum class Outcome { done, stalled, timed_out, gone };
  virtual ~UsbDevice() = default;
  /// A vendor request to the device, host to device.
  virtual Outcome control_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                              std::span<const std::uint8_t> data, Duration timeout) = 0;
};

/// One HID device. One thread at a time.
class HidDevice {
 public:
  virtual ~HidDevice() = default;
  /// One input report, its number first where the device numbers them; 0 = none within `timeout`,
  /// nullopt = gone.
  virtual std::optional<std::size_t> read(std::span<std::uint8_t> into, Duration timeout) = 0;
  virtual bool write(std::span<const std::uint8_t> report) = 0;
};

struct GpioSettings {
  std::string chip;  ///< "gpiochip0" or its label
  unsigned line = 0;
  bool output = false, active_low = false, pull_up = false;
};
/// One GPIO line. One thread at a time.
class GpioLine {
 public:
  virtual ~GpioLine() = default;
  /// The level now, after active_low; nullopt = gone.
  virtual std::optional<bool> get() = 0;
  virtual bool set(bool on) = 0;
};

/// A MIDI device's two directions. One thread at a time.
class MidiPort {
 public:
  virtual ~MidiPort() = default;
  /// The next whole message; 0 = none waits, nullopt = gone.
  virtual std::optional<std::size_t> receive(std::span<std::uint8_t> into) = 0;
  virtual bool send(std::span<const std::uint8_t> message) = 0;
};

/// Where a Modbus line is and how it is spoken to.
struct ModbusLine {
  std::string host;  ///< TCP when given
  std::uint16_t port = 502;
  DeviceMatch serial;  ///< RTU otherwise
  SerialSettings settings{9600, 8, 1, 'N'};
  friend bool operator==(const ModbusLine& a, const ModbusLine& b) {
    return a.host == b.host && a.port == b.port && a.serial == b.serial &&
           a.settings.baud == b.settings.baud && a.settings.parity == b.settings.parity &&
           a.settings.stop_bits == b.settings.stop_bits;
  }
};
/// A Modbus line as its only master. One thread; every call waits for the answer or the timeout.
class ModbusLink {
 public:
  enum class Outcome {
    done,
    no_answer,  ///< the device said nothing in time, or nonsense
    refused,    ///< the device answered with an exception
    gone        ///< the line itself is lost: open it again
  };
  virtual ~ModbusLink() = default;
  /// Addresses as on the wire: they start at 0. Unit 0 is a broadcast without answer.
  virtual Outcome write(std::uint8_t unit, std::uint16_t address,
                        std::span<const std::uint16_t> values, Duration timeout) = 0;
  virtual Outcome write_single(std::uint8_t unit, std::uint16_t address, std::uint16_t value,
                               Duration timeout) = 0;
  virtual Outcome read(std::uint8_t unit, bool input_registers, std::uint16_t address,
                       std::span<std::uint16_t> into, Duration timeout) = 0;
};

/// Whole universes given to another lighting program on this machine (OLA). One thread at a time.
class DmxStream {
 public:
  virtual ~DmxStream() = default;
  virtual bool send(std::uint16_t universe, std::span<const std::uint8_t> levels) = 0;
};

/// Thread-safe. Each `open` fails with a problem that says what to do; where the library was
/// missing when Chiaro was built the problem begins "built without".
class Devices {
 public:
  virtual ~Devices() = default;
  /// What is plugged in now; asked anew at every call, so that nothing depends on udev.
  virtual std::vector<DeviceFound> usb() = 0;
  virtual std::vector<DeviceFound> hid() = 0;
  virtual core::Result<std::unique_ptr<SerialPort>> open_serial(const DeviceMatch& match,
                                                                const SerialSettings& settings) = 0;
  virtual core::Result<std::unique_ptr<UsbDevice>> open_usb(const DeviceMatch& match) = 0;
  virtual core::Result<std::unique_ptr<HidDevice>> open_hid(const DeviceMatch& match) = 0;
  virtual core::Result<std::unique_ptr<GpioLine>> open_gpio(const GpioSettings& settings) = 0;
  /// The device whose name contains `name`.
  virtual core::Result<std::unique_ptr<MidiPort>> open_midi(const std::string& name) = 0;
  virtual core::Result<std::unique_ptr<ModbusLink>> open_modbus(const ModbusLine& line) = 0;
  virtual core::Result<std::unique_ptr<DmxStream>> open_ola() = 0;
};

/// The one device among `found` that is meant; a problem when there is none, or more than one, and
/// then the remedy tells how to say which.
core::Result<DeviceFound> choose(const DeviceMatch& match, const std::vector<DeviceFound>& found);

}  // namespace chiaro::ports
