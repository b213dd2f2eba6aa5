// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "controller/studio/checks/checks.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::checks {

void check_outputs(const Studio& studio, reading::Report& report) {
  std::set<std::uint16_t> wired, used;
  for (const Output& output : studio.outputs) wired.insert(output.universe);
  for (const Fixture& fixture : studio.fixtures) {
    const auto* dmx = std::get_if<DmxPatch>(&fixture.patch);
    if (dmx == nullptr || !used.insert(dmx->universe).second) continue;
    const std::string number = std::to_string(dmx->universe);
    if (!wired.contains(dmx->universe))
      report.add({fixture.patch_place,
                  reading::in_quotes(fixture.name) + " is patched to universe " + number +
                      ", which has no output",
                  "add outputs: {universe " + number + ": {sacn: {interface: eth0}}}", false});
  }
  for (const Output& output : studio.outputs)
    if (!used.contains(output.universe))
      report.add({output.place,
                  "universe " + std::to_string(output.universe) + " carries no fixture",
                  "delete this output, or patch a fixture to it", true});
}

}  // namespace chiaro::studio::checks
