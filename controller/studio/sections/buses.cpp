// SPDX-License-Identifier: Apache-2.0
// buses: - Modbus lines, serial or over TCP, that fixtures and axes are patched to.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

ModbusOutput read_modbus_output(const Tree& tree, const Studio& studio, Context& context) {
  Report& report = context.report;
  Section section(tree, "a Modbus device", report);
  ModbusOutput modbus;
  const Tree* bus = section.need("bus", "rack");
  if (const auto name = text(bus, report); name && bus_exists(*bus, *name, studio, context))
    modbus.bus = *name;
  into(modbus.unit, whole(section.need("unit", "1"), 1, 247, report));
  into(modbus.rate_hz, quantity(section.find("rate"), Measure::frequency, {1, 44}, report));
  const Tree* map = section.need("map", "waveshare/analog-output-8ch");
  if (const auto name = text(map, report)) {
    auto loaded =
        load_register_map(*name, context.base / "modbus", context.folders.config / "modbus");
    if (loaded) {
      modbus.map = std::move(*loaded);
    } else {
      for (core::Problem problem : loaded.problems()) {
        if (problem.where.file.empty()) problem.where = report.place(*map);
        report.add(std::move(problem));
      }
    }
  }
  section.refuse_unknown();
  return modbus;
}

void read_buses(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("buses");
  if (tree == nullptr) return;
  Report& report = context.report;
  Section section(*tree, "buses", report);
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    check_name(tree->keys[i], context);
    Section body(tree->items[i], "a bus", report);
    Bus bus{tree->keys[i].text, "", 9600, report.place(tree->keys[i])};
    const Tree* device = body.find("device");
    const bool named = device != nullptr || body.has("serial") || body.has("path");
    if (!named) body.need("device", "/dev/ttyUSB0");
    into(bus.device, text(device, report));
    if (!bus.device.empty() && bus.device.rfind("/dev/", 0) != 0 &&
        bus.device.rfind("tcp://", 0) != 0)
      report.error(*device, in_quotes(bus.device) + " is neither a serial device nor a TCP address",
                   "for example /dev/ttyUSB0 or tcp://192.168.0.30:502");
    if (named && bus.device.rfind("tcp://", 0) != 0 && bus.device.rfind("/dev/", 0) == 0)
      bus.adapter.node = bus.device;
    else if (device == nullptr && named)
      bus.adapter = read_device(body, report);
    into(bus.parity,
         choice<char>(body.find("parity"), {{"none", 'N'}, {"even", 'E'}, {"odd", 'O'}}, report));
    into(bus.stop_bits, whole(body.find("stop_bits"), 1, 2, report));
    into(bus.baud, whole(body.find("baud"), 1200, 921600, report));
    body.refuse_unknown();
    studio.buses.push_back(std::move(bus));
  }
}

}  // namespace chiaro::studio::sections
