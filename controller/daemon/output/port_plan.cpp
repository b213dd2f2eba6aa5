// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/port_plan.h"

#include <algorithm>

namespace chiaro::daemon {
namespace {

ports::DeviceMatch match_of(const studio::DeviceName& device) {
  return {device.node, device.vendor, device.product, device.serial, device.usb_path, "", ""};
}

/// Fills in what each kind of output says of itself.
struct Filler {
  PortPlan& plan;
  drivers::OutputSettings& settings;

  void operator()(const studio::SacnOutput& sacn) {
    plan.driver = "sacn";
    settings.interface = sacn.interface;
    settings.unicast = sacn.unicast;
    settings.priority = sacn.priority;
    settings.sync = sacn.sync;
    settings.quiet = sacn.quiet;
  }
  void operator()(const studio::MockOutput&) { plan.driver = "mock"; }
  void operator()(const studio::ArtNetOutput& artnet) {
    plan.driver = "artnet";
    settings.interface = artnet.interface;
    settings.unicast = artnet.unicast;
    settings.port_address = artnet.port_address;
    settings.broadcast = artnet.broadcast;
    settings.art_sync = artnet.sync;
    settings.quiet = artnet.quiet;
  }
  void operator()(const studio::UsbProOutput& pro) {
    plan.driver = "usbpro";
    settings.device = match_of(pro.device);
    settings.dongle_port = pro.port;
    settings.break_us = pro.break_us;
    settings.mab_us = pro.mab_us;
  }
  void operator()(const studio::OpenDmxOutput& open) {
    plan.driver = "opendmx";
    settings.device = match_of(open.device);
    settings.slots = open.slots;
    settings.break_us = open.break_us;
    settings.mab_us = open.mab_us;
  }
  void operator()(const studio::UdmxOutput& udmx) {
    plan.driver = "udmx";
    settings.device = match_of(udmx.device);
    settings.slots = udmx.slots;
  }
  void operator()(const studio::OlaOutput& ola) {
    plan.driver = "ola";
    settings.ola_universe = ola.universe;
  }
};

/// Whether two outputs leave by one interface and are synchronised as one.
bool together(const studio::OutputDriver& a, const studio::OutputDriver& b) {
  if (const auto* sacn = std::get_if<studio::SacnOutput>(&a)) {
    const auto* other = std::get_if<studio::SacnOutput>(&b);
    return other != nullptr && other->interface == sacn->interface && other->sync == sacn->sync;
  }
  const auto* artnet = std::get_if<studio::ArtNetOutput>(&a);
  const auto* other = std::get_if<studio::ArtNetOutput>(&b);
  return artnet != nullptr && other != nullptr && other->interface == artnet->interface;
}

}  // namespace

PortPlan plan_of(const studio::Studio& studio, const studio::Output& output,
                 const std::array<std::uint8_t, 16>& cid) {
  PortPlan plan;
  plan.rate_hz = studio::rate_of(output.driver);
  plan.settings.universe = output.universe;
  plan.settings.cid = cid;
  plan.settings.source_name = "Chiaro: " + studio.name;
  plan.settings.rate_hz = plan.rate_hz;
  std::visit(Filler{plan, plan.settings}, output.driver);
  for (const auto& other : studio.outputs)
    if (together(output.driver, other.driver)) plan.settings.together.push_back(other.universe);
  std::sort(plan.settings.together.begin(), plan.settings.together.end());
  return plan;
}

}  // namespace chiaro::daemon
