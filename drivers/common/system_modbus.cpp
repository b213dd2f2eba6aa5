// SPDX-License-Identifier: Apache-2.0
// Modbus lines by libmodbus. Its own recovery stays off: it would block and retry inside a call;
// who calls decides what a silence means.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_MODBUS
#include <cerrno>
#include <modbus.h>
#include <sys/file.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_MODBUS
namespace {

class Line final : public ports::ModbusLink {
 public:
  explicit Line(modbus_t* context) : context_(context) {}
  ~Line() override {
    if (context_ == nullptr) return;
    modbus_close(context_);
    modbus_free(context_);
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  bool connect() {
    if (context_ == nullptr) return false;
    modbus_set_error_recovery(context_, MODBUS_ERROR_RECOVERY_NONE);
    modbus_set_response_timeout(context_, 1, 0);
    if (modbus_connect(context_) != 0) return false;
    return ::flock(modbus_get_socket(context_), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }

  Outcome write(std::uint8_t unit, std::uint16_t address, std::span<const std::uint16_t> values,
                ports::Duration timeout) override {
    address_device(unit, timeout);
    return judge(
        modbus_write_registers(context_, address, static_cast<int>(values.size()), values.data()),
        unit);
  }
  Outcome write_single(std::uint8_t unit, std::uint16_t address, std::uint16_t value,
                       ports::Duration timeout) override {
    address_device(unit, timeout);
    return judge(modbus_write_register(context_, address, value), unit);
  }
  Outcome read(std::uint8_t unit, bool input_registers, std::uint16_t address,
               std::span<std::uint16_t> into, ports::Duration timeout) override {
    address_device(unit, timeout);
    const auto call = input_registers ? modbus_read_input_registers : modbus_read_registers;
    return judge(call(context_, address, static_cast<int>(into.size()), into.data()), unit);
  }

 private:
  void address_device(std::uint8_t unit, ports::Duration timeout) {
    // What a device said too late must not be taken for the next one's answer.
    modbus_flush(context_);
    modbus_set_slave(context_, unit);
    const auto us = std::chrono::ceil<std::chrono::microseconds>(timeout).count();
    modbus_set_response_timeout(context_, static_cast<std::uint32_t>(us / 1000000),
                                static_cast<std::uint32_t>(us % 1000000));
  }
  static Outcome judge(int result, std::uint8_t unit) {
    if (result >= 0) return Outcome::done;
    if (unit == 0 && errno == ETIMEDOUT) return Outcome::done;  // a broadcast has no answer
    if (errno > MODBUS_ENOBASE && errno <= EMBXGTAR) return Outcome::refused;
    switch (errno) {
      case EBADF:
      case EIO:
      case ENODEV:
      case ENXIO:
      case EPIPE:
      case ECONNRESET:
      case ECONNREFUSED:
        return Outcome::gone;
      default:
        return Outcome::no_answer;
    }
  }
  modbus_t* const context_;
};

}  // namespace

core::Result<std::unique_ptr<ports::ModbusLink>> SystemDevices::open_modbus(
    const ports::ModbusLine& line) {
  std::string node = line.serial.node;
  if (line.host.empty() && !(line.serial == ports::DeviceMatch{.node = node})) {
    const auto chosen = ports::choose(line.serial, usb());
    if (!chosen) return chosen.problems();
    node = chosen->identity.node;
    if (node.empty())
      return core::Problem{{},
                           to_string(chosen->identity) + " has no serial device",
                           "load its kernel driver, for example `sudo modprobe ftdi_sio`"};
  }
  const auto port = std::to_string(line.port);
  auto link = std::make_unique<Line>(
      line.host.empty() ? modbus_new_rtu(node.c_str(), line.settings.baud, line.settings.parity,
                                         line.settings.data_bits, line.settings.stop_bits)
                        : modbus_new_tcp_pi(line.host.c_str(), port.c_str()));
  if (link->connect()) return std::unique_ptr<ports::ModbusLink>(std::move(link));
  const std::string where = line.host.empty() ? node : line.host + ":" + port;
  const std::string why = modbus_strerror(errno);
  return core::Problem{{},
                       "cannot reach the Modbus line at " + where + ": " + why,
                       line.host.empty() ? "`chiaro doctor` checks who may use it"
                                         : "is the gateway on? `ping " + line.host + "`"};
}
#else
core::Result<std::unique_ptr<ports::ModbusLink>> SystemDevices::open_modbus(
    const ports::ModbusLine& line) {
  return built_without(
      "libmodbus", "the Modbus line at " + (line.host.empty() ? to_string(line.serial) : line.host),
      "libmodbus-dev");
}
#endif
}  // namespace chiaro::drivers
