// SPDX-License-Identifier: Apache-2.0
// Devices in memory that can be plugged in and out, be slow, lose, fail and refuse, and that
// remember what was done to them.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "controller/ports/devices.h"
#include "tests/support/fake_clock.h"

namespace chiaro::support {

using Bytes = std::vector<std::uint8_t>;

/// What every fake can be told to do wrong, and what it counts. Guarded by the fake's own mutex.
struct FakeDevice {
  ports::DeviceFound found;
  bool plugged = true;
  bool forbidden = false;   ///< opening says "permission denied"
  int fail_next = 0;        ///< so many calls fail
  int lose_next = 0;        ///< so many messages vanish without a trace
  ports::Duration delay{};  ///< each call takes so long on `clock`
  FakeClock* clock = nullptr;
  int opens = 0, open_now = 0, calls = 0;
  mutable std::mutex mutex;

  /// With the mutex held: whether this call works; takes its time.
  bool works();
};

/// A serial line's far end.
struct FakeSerial : FakeDevice {
  struct Event {
    enum Kind { written, break_on, break_off, drained } kind;
    Bytes bytes;
    bool operator==(const Event&) const = default;
  };
  std::vector<Event> events;
  std::deque<std::uint8_t> to_read;
  ports::SerialSettings settings;
  /// What the far end says to what was just written.
  std::function<Bytes(std::span<const std::uint8_t>)> answer;
  Bytes all_written() const;
};

struct FakeUsb : FakeDevice {
  struct Request {
    std::uint8_t request = 0;
    std::uint16_t value = 0, index = 0;
    Bytes data;
    bool operator==(const Request&) const = default;
  };
  std::vector<Request> requests;
  int stall_next = 0;
};

struct FakeHid : FakeDevice {
  std::deque<Bytes> to_read;
  std::vector<Bytes> written;
};

struct FakeGpioLine : FakeDevice {
  ports::GpioSettings settings;
  bool level = false;
  std::vector<bool> set_to;
};

struct FakeMidi : FakeDevice {
  std::deque<Bytes> to_read;
  std::vector<Bytes> written;
};

/// Devices on one Modbus line: registers by unit. A unit that is not there does not answer.
struct FakeModbus : FakeDevice {
  struct Write {
    std::uint8_t unit = 0;
    std::uint16_t address = 0;
    std::vector<std::uint16_t> values;
    bool single = false;
    bool operator==(const Write&) const = default;
  };
  struct Unit {
    std::map<std::uint16_t, std::uint16_t> holding, input;
    ports::Duration takes{};  ///< how long it needs to answer
    bool silent = false, refuses = false;
  };
  std::map<std::uint8_t, Unit> units;
  std::vector<Write> writes;
  std::vector<ports::Duration> timeouts;
  int reads = 0;
};

struct FakeOla : FakeDevice {
  std::vector<std::pair<std::uint16_t, Bytes>> sent;
};

/// Thread-safe. Plugging gives a handle that tests keep; what is opened shares it.
class FakeDevices final : public ports::Devices {
 public:
  FakeDevices();
  ~FakeDevices() override;
  std::shared_ptr<FakeSerial> plug_serial(const ports::DeviceMatch& identity,
                                          const std::string& kernel_driver = "ftdi_sio");
  std::shared_ptr<FakeUsb> plug_usb(const ports::DeviceMatch& identity);
  std::shared_ptr<FakeHid> plug_hid(const ports::DeviceMatch& identity);
  std::shared_ptr<FakeGpioLine> plug_gpio(const std::string& chip, unsigned line);
  std::shared_ptr<FakeMidi> plug_midi(const std::string& name);
  /// At that host, or on that serial device.
  std::shared_ptr<FakeModbus> plug_modbus(const std::string& host_or_node);
  std::shared_ptr<FakeOla> plug_ola();

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
  std::mutex mutex_;
  std::vector<std::shared_ptr<FakeSerial>> serials_;
  std::vector<std::shared_ptr<FakeUsb>> usbs_;
  std::vector<std::shared_ptr<FakeHid>> hids_;
  std::vector<std::shared_ptr<FakeGpioLine>> gpios_;
  std::vector<std::shared_ptr<FakeMidi>> midis_;
  std::vector<std::shared_ptr<FakeModbus>> modbuses_;
  std::shared_ptr<FakeOla> ola_;
};

}  // namespace chiaro::support
