// SPDX-License-Identifier: Apache-2.0
#include "controller/ports/devices.h"

#include <algorithm>
#include <cstdio>

namespace chiaro::ports {

std::string to_string(const DeviceMatch& match) {
  std::string text = match.node;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
  if (match.vendor != 0 || match.product != 0) {
    char ids[16];
    std::snprintf(ids, sizeof ids, "%04x:%04x", match.vendor, match.product);
    add(ids);
  }
  if (!match.serial.empty()) add("serial " + match.serial);
  if (!match.usb_path.empty()) add("at USB " + match.usb_path);
  if (!match.name.empty()) add("'" + match.name + "'");
  return text.empty() ? "any device" : text;
}

bool matches(const DeviceMatch& wanted, const DeviceMatch& found) {
  const auto same = [](const std::string& a, const std::string& b) { return a.empty() || a == b; };
  return same(wanted.node, found.node) && same(wanted.serial, found.serial) &&
         same(wanted.usb_path, found.usb_path) && same(wanted.manufacturer, found.manufacturer) &&
         same(wanted.name, found.name) && (wanted.vendor == 0 || wanted.vendor == found.vendor) &&
         (wanted.product == 0 || wanted.product == found.product);
}

core::Result<DeviceFound> choose(const DeviceMatch& match, const std::vector<DeviceFound>& found) {
  const auto fits = [&](const DeviceFound& one) { return matches(match, one.identity); };
  const auto first = std::find_if(found.begin(), found.end(), fits);
  if (first == found.end())
    return core::Problem{{},
                         to_string(match) + " is not plugged in",
                         "plug it in; `chiaro doctor` lists what is there"};
  const auto second = std::find_if(std::next(first), found.end(), fits);
  if (second == found.end()) return *first;
  const bool same_serial = first->identity.serial == second->identity.serial;
  return core::Problem{{},
                       "more than one device is " + to_string(match) + ": " +
                           to_string(first->identity) + " and " + to_string(second->identity),
                       same_serial ? "say which with path: \"" + first->identity.usb_path + "\""
                                   : "say which with serial: \"" + first->identity.serial + "\""};
}

}  // namespace chiaro::ports
