// SPDX-License-Identifier: Apache-2.0
// Whether what a studio file names is there.
#include <fstream>
#include <set>

#include "controller/daemon/doctor/doctor.h"

namespace chiaro::daemon::doctor {
namespace {

namespace fs = std::filesystem;

ports::DeviceMatch match_of(const studio::DeviceName& device) {
  return {device.node, device.vendor, device.product, device.serial, device.usb_path, "", ""};
}

struct Look {
  const fs::path& root;
  ports::Devices& devices;
  std::vector<Finding>& findings;

  void interface(const std::string& name) {
    std::error_code code;
    const auto folder = root / "sys/class/net" / name;
    if (!fs::exists(folder, code)) {
      findings.push_back({Finding::State::bad, "studio",
                          "there is no network interface '" + name + "'",
                          "ip -br link   # lists their names; correct the studio file"});
      return;
    }
    std::ifstream in(folder / "operstate");
    std::string state;
    in >> state;
    const bool down = state == "down";
    findings.push_back({down ? Finding::State::bad : Finding::State::good, "studio",
                        "network interface " + name + (down ? " is down" : " is there"),
                        down ? "sudo ip link set " + name + " up   # or plug its cable in" : ""});
  }
  void device(const studio::DeviceName& named) {
    const auto match = match_of(named);
    const bool node_only = match == ports::DeviceMatch{.node = match.node};
    std::error_code code;
    if (node_only) {
      const bool there = fs::exists(root / match.node.substr(1), code);
      findings.push_back({there ? Finding::State::good : Finding::State::bad, "studio",
                          match.node + (there ? " is there" : " is not there"),
                          there ? "" : "ls -l /dev/serial/by-id   # shows what is plugged in"});
      return;
    }
    const auto chosen = ports::choose(match, devices.usb());
    findings.push_back(
        {chosen ? Finding::State::good : Finding::State::bad, "studio",
         chosen ? to_string(chosen->identity) + " is plugged in" : chosen.problems()[0].what,
         chosen ? "" : "lsusb   # shows what is plugged in"});
  }

  /// A surface's device is there or not; GPIO lines are asked for by opening them, which only the
  /// hand does.
  void surface(const studio::Surface& surface) {
    const auto tell = [&](bool good, const std::string& what, const std::string& command) {
      findings.push_back({good ? Finding::State::good : Finding::State::bad, "surface",
                          "'" + surface.name + "': " + what, good ? "" : command});
    };
    std::size_t uses = 0;
    for (const auto& control : surface.map.controls) uses += control.deeds.size();
    const std::string with = surface.map.maker + " " + surface.map.device + ", " +
                             std::to_string(surface.map.controls.size()) + " controls";
    if (surface.driver == "osc") {
      interface(surface.interface);
      tell(true, with + ", listens on UDP port " + std::to_string(surface.port), "");
    } else if (surface.driver == "midi") {
      const auto opened = devices.open_midi(surface.midi_name);
      tell(opened.ok(), opened ? with + ", is plugged in" : opened.problems()[0].what,
           "aconnect -l   # lists what is plugged in, from package alsa-utils");
    } else if (surface.driver == "hid") {
      const auto chosen = ports::choose(match_of(surface.device), devices.hid());
      tell(chosen.ok(), chosen ? with + ", is plugged in" : chosen.problems()[0].what,
           "lsusb   # shows what is plugged in");
    } else if (surface.driver == "gpio") {
      for (const auto& chip : chips(surface)) {
        std::error_code code;
        const bool there = fs::exists(root / "dev" / chip, code);
        tell(there, there ? with + ", on " + chip : "there is no GPIO chip " + chip,
             "gpiodetect   # lists them, from package gpiod");
      }
    }
    if (uses == 0 && surface.driver != "mock")
      findings.push_back({Finding::State::note, "surface",
                          "'" + surface.name + "' has no control that does anything",
                          "give one a `do` in the studio file"});
  }
  static std::set<std::string> chips(const studio::Surface& surface) {
    std::set<std::string> names;
    for (const auto& control : surface.map.controls) names.insert(control.chip);
    return names;
  }

  void operator()(const studio::SacnOutput& sacn) { interface(sacn.interface); }
  void operator()(const studio::ArtNetOutput& artnet) { interface(artnet.interface); }
  void operator()(const studio::UsbProOutput& pro) { device(pro.device); }
  void operator()(const studio::OpenDmxOutput& open) { device(open.device); }
  void operator()(const studio::UdmxOutput& udmx) {
    studio::DeviceName device_name = udmx.device;
    device_name.vendor = 0x16c0;
    device_name.product = 0x05dc;
    device(device_name);
  }
  void operator()(const studio::OlaOutput&) {}
  void operator()(const studio::ModbusOutput&) {}
  void operator()(const studio::MockOutput&) {}
};

}  // namespace

void examine_studio(const fs::path& root, const studio::Studio& studio, ports::Devices& devices,
                    std::vector<Finding>& findings) {
  std::vector<Finding> all;
  Look look{root, devices, all};
  for (const auto& output : studio.outputs) std::visit(look, output.driver);
  for (const auto& bus : studio.buses)
    if (bus.device.rfind("tcp://", 0) != 0) look.device(bus.adapter);
  for (const auto& surface : studio.surfaces) look.surface(surface);
  for (const auto& camera : studio.cameras)
    if (camera.source.rfind("v4l2:", 0) == 0) look.device({camera.source.substr(5), 0, 0, "", ""});
  std::set<std::string> told;  // many universes may share an interface
  for (auto& finding : all)
    if (told.insert(finding.what).second) findings.push_back(std::move(finding));
}

}  // namespace chiaro::daemon::doctor
