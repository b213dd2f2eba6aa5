// SPDX-License-Identifier: Apache-2.0
// Something for every output driver to be plugged into, and one switch that pulls the plug.
#pragma once

#include <memory>
#include <string>

#include "drivers/registry.h"
#include "tests/support/fake_clock.h"
#include "tests/support/fake_devices.h"
#include "tests/support/fake_network.h"

namespace chiaro::support {

/// Settings and a far end for one driver by name; a name that is not known here has no far end, and
/// its contract tests fail until it gets one.
class StageForOutputs {
 public:
  explicit StageForOutputs(const std::string& driver);

  bool known() const { return known_; }
  drivers::Surroundings& around() { return around_; }
  const drivers::OutputSettings& settings() const { return settings_; }
  /// Everything at the far end goes away, or comes back.
  void unplug(bool unplugged);
  /// Whatever has reached the far end, counted.
  std::size_t reached() const;
  FakeNetwork& network() { return network_; }
  FakeDevices& devices() { return devices_; }
  FakeClock& clock() { return clock_; }
  FakeSerial* serial() { return serial_.get(); }
  FakeUsb* usb() { return usb_.get(); }
  FakeOla* ola() { return ola_.get(); }
  FakeModbus* modbus() { return modbus_.get(); }

 private:
  FakeNetwork network_;
  FakeDevices devices_;
  FakeClock clock_{FakeClock::Sleep::jumps};
  drivers::Surroundings around_{network_, devices_, clock_};
  drivers::OutputSettings settings_;
  std::shared_ptr<FakeSerial> serial_;
  std::shared_ptr<FakeUsb> usb_;
  std::shared_ptr<FakeOla> ola_;
  std::shared_ptr<FakeModbus> modbus_;
  bool known_ = true;
};

/// What a DMX USB Pro says when it is asked for its parameters.
Bytes usbpro_answers(std::span<const std::uint8_t> asked);

}  // namespace chiaro::support
