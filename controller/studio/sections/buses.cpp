// SPDX-License-Identifier: Apache-2.0
// buses: - Modbus lines, serial or over TCP, that fixtures and axes are patched to.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

void read_buses(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("buses");
  if (tree == nullptr) return;
  Report& report = context.report;
  Section section(*tree, "buses", report);
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    check_name(tree->keys[i], context);
    Section body(tree->items[i], "a bus", report);
    Bus bus{tree->keys[i].text, "", 9600, report.place(tree->keys[i])};
    const Tree* device = body.need("device", "/dev/ttyUSB0");
    into(bus.device, text(device, report));
    if (!bus.device.empty() && bus.device.rfind("/dev/", 0) != 0 &&
        bus.device.rfind("tcp://", 0) != 0)
      report.error(*device, in_quotes(bus.device) + " is neither a serial device nor a TCP address",
                   "for example /dev/ttyUSB0 or tcp://192.168.0.30:502");
    into(bus.baud, whole(body.find("baud"), 1200, 921600, report));
    body.refuse_unknown();
    studio.buses.push_back(std::move(bus));
  }
}

}  // namespace chiaro::studio::sections
