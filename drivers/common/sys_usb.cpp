// SPDX-License-Identifier: Apache-2.0
// What is plugged in, from /sys: the same identities whether or not udev runs, and without opening
// a single device.
#include <algorithm>
#include <fstream>
#include <system_error>

#include "drivers/common/system_devices.h"

namespace chiaro::drivers {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::uint16_t hexadecimal(const std::string& text) {
  return static_cast<std::uint16_t>(std::strtoul(text.c_str(), nullptr, 16));
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code))
    found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

ports::DeviceMatch identity_of(const fs::path& device) {
  return {"",
          hexadecimal(line_of(device / "idVendor")),
          hexadecimal(line_of(device / "idProduct")),
          line_of(device / "serial"),
          device.filename().string(),
          line_of(device / "manufacturer"),
          line_of(device / "product")};
}

/// The tty below an interface: ttyUSB0 stands in it, ttyACM0 in its tty folder.
std::string tty_of(const fs::path& interface) {
  for (const auto& entry : entries(interface)) {
    const std::string name = entry.filename().string();
    if (name.rfind("ttyUSB", 0) == 0) return "/dev/" + name;
  }
  for (const auto& entry : entries(interface / "tty")) return "/dev/" + entry.filename().string();
  return "";
}

}  // namespace

std::vector<ports::DeviceFound> SystemDevices::usb() {
  std::vector<ports::DeviceFound> found;
  for (const auto& device : entries(root_ / "sys/bus/usb/devices")) {
    std::error_code code;
    if (!fs::exists(device / "idVendor", code)) continue;  // an interface, not a device
    ports::DeviceFound one{identity_of(device), ""};
    const std::string prefix = device.filename().string() + ":";
    for (const auto& entry : entries(device)) {
      if (entry.filename().string().rfind(prefix, 0) != 0) continue;
      const auto driver = fs::read_symlink(entry / "driver", code);
      if (!code && one.kernel_driver.empty()) one.kernel_driver = driver.filename().string();
      if (one.identity.node.empty()) one.identity.node = tty_of(entry);
    }
    found.push_back(std::move(one));
  }
  return found;
}

std::vector<ports::DeviceFound> SystemDevices::hid() {
  std::vector<ports::DeviceFound> found;
  for (const auto& node : entries(root_ / "sys/class/hidraw")) {
    std::error_code code;
    ports::DeviceFound one;
    one.identity.node = "/dev/" + node.filename().string();
    // HID_ID=0003:00001209:0000BEEF: bus, vendor, product.
    std::ifstream in(node / "device/uevent");
    for (std::string line; std::getline(in, line);) {
      const auto equals = line.find('=');
      const std::string key = line.substr(0, equals), value = line.substr(equals + 1);
      if (key == "HID_ID" && value.size() >= 22) {
        one.identity.vendor = hexadecimal(value.substr(5, 8));
        one.identity.product = hexadecimal(value.substr(14, 8));
      }
      if (key == "HID_NAME") one.identity.name = value;
      if (key == "HID_UNIQ") one.identity.serial = value;
    }
    // The USB device is above the HID one: .../1-1/1-1:1.0/0003:1209:BEEF.0001
    const auto place = fs::canonical(node / "device", code);
    if (!code && fs::exists(place.parent_path().parent_path() / "idVendor", code))
      one.identity.usb_path = place.parent_path().parent_path().filename().string();
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace chiaro::drivers
