// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/port_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace chiaro::daemon {
namespace {

ports::DeviceMatch match_of(const studio::DeviceName& device) {
  return {device.node, device.vendor, device.product, device.serial, device.usb_path, "", ""};
}

ports::Duration seconds(double s) { return ports::Duration(std::llround(s * 1e9)); }

/// "tcp://host:502" or a serial adapter.
ports::ModbusLine line_of(const studio::Bus& bus) {
  ports::ModbusLine line;
  line.settings = {bus.baud, 8, bus.stop_bits, bus.parity};
  constexpr std::string_view kTcp = "tcp://";
  if (bus.device.rfind(kTcp, 0) != 0) {
    line.serial = match_of(bus.adapter);
    return line;
  }
  const std::string rest = bus.device.substr(kTcp.size());
  const auto colon = rest.rfind(':');
  line.host = rest.substr(0, colon);
  if (colon != std::string::npos)
    line.port = static_cast<std::uint16_t>(std::strtoul(rest.c_str() + colon + 1, nullptr, 10));
  return line;
}

/// As the map says; unit, patience and pace are the module's and the lamp's.
drivers::modbus::AxisSettings axis_in(const studio::RegisterAxis& axis) {
  drivers::modbus::AxisSettings settings;
  settings.slot = static_cast<std::uint16_t>(axis.slot);
  settings.target = static_cast<std::uint16_t>(axis.target);
  settings.words = static_cast<std::uint8_t>(axis.words);
  settings.low_word_first = axis.low_word_first;
  settings.from = axis.from;
  settings.to = axis.to;
  settings.actual = axis.actual;
  settings.actual_is_input = axis.actual_is_input;
  settings.status = axis.status;
  settings.status_is_input = axis.status_is_input;
  settings.moving_bit = axis.moving_bit;
  settings.homed_bit = axis.homed_bit;
  settings.fault_bit = axis.fault_bit;
  settings.home = axis.home;
  settings.stop = axis.stop;
  settings.home_value = static_cast<std::uint16_t>(axis.home_value);
  settings.stop_value = static_cast<std::uint16_t>(axis.stop_value);
  return settings;
}

/// Fills in what each kind of output says of itself.
struct Filler {
  const studio::Studio& studio;
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
  void operator()(const studio::ModbusOutput& modbus) {
    plan.driver = "modbus";
    for (const auto& bus : studio.buses)
      if (bus.name == modbus.bus) settings.line = line_of(bus);
    settings.module.unit = static_cast<std::uint8_t>(modbus.unit);
    settings.module.timeout = seconds(modbus.map.timeout_s);
    settings.module.least_gap = seconds(modbus.map.gap_s);
    settings.module.single_writes = modbus.map.single_writes;
    for (const auto& channel : modbus.map.channels)
      settings.module.channels.push_back(
          {static_cast<std::uint16_t>(channel.slot), static_cast<std::uint8_t>(channel.slots),
           static_cast<std::uint16_t>(channel.address), static_cast<std::uint8_t>(channel.words),
           channel.low_word_first, channel.from, channel.to,
           channel.dali ? drivers::modbus::Channel::Law::dali
                        : drivers::modbus::Channel::Law::linear});
    for (const auto& axis : modbus.map.axes) settings.axes.push_back(axis_of(axis));
  }
  drivers::modbus::AxisSettings axis_of(const studio::RegisterAxis& axis) const {
    auto motor = axis_in(axis);
    motor.unit = settings.module.unit;
    motor.timeout = settings.module.timeout;
    motor.least_gap = settings.module.least_gap;
    for (const auto& fixture : studio.fixtures)
      if (const auto far = fixture.far_motor(); far &&
                                                far->patch.universe == plan.settings.universe &&
                                                far->patch.address == axis.slot + 1)
        motor.end_to_end_s = fixture.limits.end_to_end_s;
    return motor;
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
  std::visit(Filler{studio, plan, plan.settings}, output.driver);
  for (const auto& other : studio.outputs)
    if (together(output.driver, other.driver)) plan.settings.together.push_back(other.universe);
  std::sort(plan.settings.together.begin(), plan.settings.together.end());
  return plan;
}

std::unique_ptr<ports::OutputPort> open_port(const PortPlan& plan, bool dry_run,
                                             drivers::Surroundings& around,
                                             core::Problems& warnings) {
  auto port = drivers::make_output(plan.driver, plan.settings, around);
  if (port && dry_run && (*port)->physical())
    port = drivers::make_output("mock", plan.settings, around);
  if (!port) return nullptr;
  if ((*port)->blocks()) return std::move(*port);
  if (const auto opened = (*port)->open(); !opened)
    for (core::Problem problem : opened.problems()) {
      problem.warning = true;
      problem.what += "; trying again every few seconds";
      warnings.push_back(problem);
    }
  return std::move(*port);
}

}  // namespace chiaro::daemon
