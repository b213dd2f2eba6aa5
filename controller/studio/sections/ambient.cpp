// SPDX-License-Identifier: Apache-2.0
// ambient: - light that is there with every lamp off: a level and colour, or a measured frame.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

void read_ambient(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("ambient");
  if (tree == nullptr) return;
  Report& report = context.report;
  Section section(*tree, "ambient light", report);
  Ambient ambient;
  const Tree* measured = section.find("measured");
  const Tree* illuminance = section.find("illuminance");
  const Tree* cct = section.find("cct");
  if (section.valid() && (measured != nullptr) == (illuminance != nullptr))
    report.error(*tree, "ambient light needs either its illuminance or a measured frame",
                 "ambient: {illuminance: 20 lx, cct: 4000 K}, or {measured: lamps-off.exr}");
  if (measured != nullptr && cct != nullptr)
    report.error(*cct, "'cct' does not go with a measured frame", "the frame has its own colours");
  if (const auto lux = quantity(illuminance, Measure::illuminance, {0, 1e6}, report))
    ambient.illuminance = {*lux};
  if (const auto kelvin = quantity(cct, Measure::temperature, {1000, 25000}, report))
    ambient.cct = {*kelvin};
  ambient.measured = existing_file(measured, "picture", context);
  section.refuse_unknown();
  studio.ambient = ambient;
}

}  // namespace chiaro::studio::sections
