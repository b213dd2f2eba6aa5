// SPDX-License-Identifier: Apache-2.0
// Outputs as people say them: on the patch sheet, in the doctor's list.
#include <cmath>
#include <cstdio>

#include "controller/studio/studio.h"

namespace chiaro::studio {
namespace {

std::string at_rate(double rate_hz) {
  return " at " + std::to_string(std::lround(rate_hz)) + " Hz";
}

std::string in_words(const DeviceName& device) {
  std::string text = device.node;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
  if (device.vendor != 0) {
    char ids[16];
    std::snprintf(ids, sizeof ids, "%04x:%04x", device.vendor, device.product);
    add(ids);
  }
  if (!device.serial.empty()) add("serial " + device.serial);
  if (!device.usb_path.empty()) add("at USB " + device.usb_path);
  return text.empty() ? text : " " + text;
}

struct InWords {
  std::string operator()(const SacnOutput& sacn) const {
    return "sACN on " + sacn.interface + at_rate(sacn.rate_hz) + ", priority " +
           std::to_string(sacn.priority) + (sacn.unicast.empty() ? "" : ", to " + sacn.unicast) +
           (sacn.sync == 0 ? "" : ", synchronised by " + std::to_string(sacn.sync));
  }
  std::string operator()(const MockOutput&) const { return "mock (no wire)"; }
  std::string operator()(const ArtNetOutput& artnet) const {
    return "Art-Net on " + artnet.interface + at_rate(artnet.rate_hz) +
           (artnet.port_address < 0 ? ""
                                    : ", port-address " + std::to_string(artnet.port_address)) +
           (artnet.broadcast         ? ", to everybody"
            : artnet.unicast.empty() ? ", to the nodes that ask"
                                     : ", to " + artnet.unicast) +
           (artnet.sync ? ", synchronised" : "");
  }
  std::string operator()(const UsbProOutput& pro) const {
    return "DMX USB Pro" + in_words(pro.device) + (pro.port == 1 ? "" : " port 2") +
           at_rate(pro.rate_hz);
  }
  std::string operator()(const OpenDmxOutput& open) const {
    return "Open DMX" + in_words(open.device) + at_rate(open.rate_hz) + " (timed by this computer)";
  }
  std::string operator()(const UdmxOutput& udmx) const {
    return "uDMX" + in_words(udmx.device) + at_rate(udmx.rate_hz);
  }
  std::string operator()(const ModbusOutput& modbus) const {
    return "Modbus unit " + std::to_string(modbus.unit) + " on bus '" + modbus.bus + "', " +
           modbus.map.maker + " " + modbus.map.device;
  }
  std::string operator()(const OlaOutput& ola) const {
    return "OLA" + (ola.universe == 0 ? "" : " universe " + std::to_string(ola.universe)) +
           at_rate(ola.rate_hz);
  }
};

}  // namespace

std::string output_in_words(const OutputDriver& driver) { return std::visit(InWords{}, driver); }

double rate_of(const OutputDriver& driver) {
  return std::visit([](const auto& one) { return one.rate_hz; }, driver);
}

}  // namespace chiaro::studio
