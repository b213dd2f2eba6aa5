// SPDX-License-Identifier: Apache-2.0
// patch: {universe: 1, address: 9}, {modbus: BUS, register: 40} or none.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

Patch read_modbus(Section& section, const Tree& bus_tree, const Studio& studio, Context& context) {
  ModbusPatch patch;
  into(patch.bus, text(&bus_tree, context.report));
  if (!patch.bus.empty()) bus_exists(bus_tree, patch.bus, studio, context);
  into(patch.register_number, whole(section.need("register", "40"), 0, 65535, context.report));
  return patch;
}

}  // namespace

Patch read_patch(const Tree* tree, const Studio& studio, Context& context) {
  if (tree == nullptr) return NoPatch{};
  if (tree->kind == Tree::Kind::scalar) {
    choice<bool>(tree, {{"none", true}}, context.report);
    return NoPatch{};
  }
  Section section(*tree, "a patch", context.report);
  if (!section.valid()) return NoPatch{};
  Patch patch = NoPatch{};
  if (const Tree* bus = section.find("modbus")) {
    patch = read_modbus(section, *bus, studio, context);
  } else {
    DmxPatch dmx;
    into(dmx.universe, whole(section.need("universe", "1"), 1, 63999, context.report));
    into(dmx.address, whole(section.need("address", "1"), 1, 512, context.report));
    patch = dmx;
  }
  section.refuse_unknown();
  return patch;
}

}  // namespace chiaro::studio::sections
