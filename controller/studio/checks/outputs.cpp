// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "controller/studio/checks/checks.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::checks {

void check_outputs(const Studio& studio, reading::Report& report) {
  std::set<std::uint16_t> wired, used;
  for (const Output& output : studio.outputs) wired.insert(output.universe);
  for (const Fixture& fixture : studio.fixtures) {
    const auto use = [&](std::uint16_t universe, const core::Place& place, const char* what) {
      if (!used.insert(universe).second || wired.contains(universe)) return;
      const std::string number = std::to_string(universe);
      report.add({place,
                  what + reading::in_quotes(fixture.name) + " is patched to universe " + number +
                      ", which has no output",
                  "add outputs: {universe " + number + ": {sacn: {interface: eth0}}}", false});
    };
    if (const auto* dmx = std::get_if<DmxPatch>(&fixture.patch))
      use(dmx->universe, fixture.patch_place, "");
    if (const auto motor = fixture.far_motor())
      use(motor->patch.universe, fixture.place, "the motor of ");
  }
  for (const Output& output : studio.outputs)
    if (!used.contains(output.universe))
      report.add({output.place,
                  "universe " + std::to_string(output.universe) + " carries no fixture",
                  "delete this output, or patch a fixture to it", true});
}

}  // namespace chiaro::studio::checks
