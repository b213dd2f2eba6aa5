// SPDX-License-Identifier: Apache-2.0
// patch: {universe: 1, address: 9}, {modbus: BUS, register: 40} or none.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

Patch read_modbus(Section& section, const Tree& bus_tree, const Studio& studio, Context& context) {
  const auto bus = text(&bus_tree, context.report);
  const auto number = whole(section.need("register", "40"), 0, 65535, context.report);
  if (!bus || !bus_exists(bus_tree, *bus, studio, context) || !number) return NoPatch{};
  return ModbusPatch{*bus, static_cast<std::uint16_t>(*number)};
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
    const auto universe = whole(section.need("universe", "1"), 1, 63999, context.report);
    const auto address = whole(section.need("address", "1"), 1, 512, context.report);
    // Half a patch is none: an invented address would overlap with innocent lamps.
    if (universe && address)
      patch = DmxPatch{static_cast<std::uint16_t>(*universe), static_cast<std::uint16_t>(*address)};
  }
  section.refuse_unknown();
  return patch;
}

}  // namespace chiaro::studio::sections
