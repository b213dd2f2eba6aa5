// SPDX-License-Identifier: Apache-2.0
#include "tests/support/stage_for_outputs.h"

namespace chiaro::support {

Bytes usbpro_answers(std::span<const std::uint8_t> asked) {
  if (asked.size() < 2 || asked[0] != 0x7e || asked[1] != 3) return {};
  return {0x7e, 3, 5, 0, 0x90, 0x01, 17, 2, 40, 0xe7};  // firmware 1.144, break, mark, rate
}

StageForOutputs::StageForOutputs(const std::string& driver) {
  settings_.device.serial = "EN1";
  around_.threads = false;
  if (driver == "artnet") {
    settings_.unicast = "127.0.0.1";
  } else if (driver == "usbpro" || driver == "opendmx") {
    serial_ = devices_.plug_serial({"/dev/ttyUSB0", 0x0403, 0x6001, "EN1", "1-1", "", ""});
    serial_->clock = &clock_;
    if (driver == "usbpro") serial_->answer = usbpro_answers;
  } else if (driver == "udmx") {
    settings_.device = {};
    usb_ = devices_.plug_usb({"", 0x16c0, 0x05dc, "", "1-2", "www.anyma.ch", "uDMX"});
  } else if (driver == "ola") {
    ola_ = devices_.plug_ola();
  } else if (driver == "modbus") {
    modbus_ = devices_.plug_modbus("10.0.0.5");
    modbus_->clock = &clock_;
    modbus_->units[1] = {};
    settings_.line.host = "10.0.0.5";
    settings_.module.channels = {{.slot = 0, .address = 0}, {.slot = 1, .address = 1}};
  } else {
    known_ = driver == "mock" || driver == "sacn";
  }
}

void StageForOutputs::unplug(bool unplugged) {
  network_.unplug(unplugged);
  for (FakeDevice* far :
       {static_cast<FakeDevice*>(serial_.get()), static_cast<FakeDevice*>(usb_.get()),
        static_cast<FakeDevice*>(ola_.get()), static_cast<FakeDevice*>(modbus_.get())}) {
    if (far == nullptr) continue;
    const std::scoped_lock lock(far->mutex);
    far->plugged = !unplugged;
  }
}

std::size_t StageForOutputs::reached() const {
  std::size_t count = network_.sent();
  if (serial_) count += serial_->events.size();
  if (usb_) count += usb_->requests.size();
  if (ola_) count += ola_->sent.size();
  if (modbus_) count += modbus_->writes.size();
  return count;
}

}  // namespace chiaro::support
