// SPDX-License-Identifier: Apache-2.0
// surfaces: - what people press, turn and slide: NAME: {midi: {map: …}}, {hid: …}, {osc: …},
// {gpio: …} or mock. The map says what each control does; `do` here changes that for this studio.
#include <algorithm>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"
#include "controller/studio/surface_deeds.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

const std::vector<std::string> kDrivers{"gpio", "hid", "midi", "osc", "mock"};

void read_map(Section& section, Surface& surface, Context& context) {
  Report& report = context.report;
  const Tree* tree = section.need("map", "generic/wall-box");
  const auto name = text(tree, report);
  if (!name) return;
  auto map =
      load_surface_map(*name, context.base / "surfaces", context.folders.config / "surfaces");
  if (!map) {
    for (core::Problem problem : map.problems()) {
      if (problem.where.file.empty()) problem.where = report.place(*tree);
      report.add(std::move(problem));
    }
    return;
  }
  surface.map = std::move(*map);
  if (surface.map.driver != surface.driver)
    report.error(*tree,
                 in_quotes(*name) + " is a map for " + surface.map.driver + ", this surface is " +
                     surface.driver,
                 "write {" + surface.map.driver + ": {map: " + *name + "}}");
}

/// do: {fader 6: {level: hair}} - this studio's own use of a control of the map.
void read_own_deeds(const Tree* tree, Surface& surface, Report& report) {
  if (tree == nullptr) return;
  Section section(*tree, "what the controls do", report);
  std::vector<std::string> known;
  for (const SurfaceControl& control : surface.map.controls) known.push_back(control.name);
  for (std::size_t i = 0; section.valid() && i < tree->keys.size(); ++i) {
    const auto control =
        std::find_if(surface.map.controls.begin(), surface.map.controls.end(),
                     [&](const auto& one) { return one.name == tree->keys[i].text; });
    if (control == surface.map.controls.end()) {
      if (!known.empty())
        report.error(
            tree->keys[i],
            in_quotes(surface.map.name) + " has no control " + in_quotes(tree->keys[i].text),
            suggestion(tree->keys[i].text, known));
      continue;
    }
    control->deeds = read_deeds(&tree->items[i], control->kind, report);
    control->shown = read_shown(nullptr, control->deeds, report);
  }
}

/// Lamps that a control moves must exist, and have what it moves.
void check_lamps(const Surface& surface, const Studio& studio, Report& report) {
  std::vector<std::string> known;
  for (const Fixture& fixture : studio.fixtures) known.push_back(fixture.name);
  const auto check = [&](const std::string& lamp, const core::Place& place) {
    if (lamp == "*" || std::find(known.begin(), known.end(), lamp) != known.end()) return;
    report.add({place,
                "there is no lamp " + in_quotes(lamp) + " for surface " + in_quotes(surface.name),
                suggestion(lamp, known), false});
  };
  for (const SurfaceControl& control : surface.map.controls) {
    for (const Deed& deed : control.deeds) check(deed.lamp, deed.place);
    if (control.deeds.empty() || control.deeds.front().lamp != control.shown.lamp)
      check(control.shown.lamp, control.shown.place);
  }
}

Surface read_surface(const Tree::Key& key, const Tree& tree, const Studio& studio,
                     Context& context) {
  Report& report = context.report;
  Surface surface;
  surface.name = key.text;
  surface.place = report.place(key);
  const auto kind = variant(&tree, "a kind of surface", kDrivers, report);
  if (!kind) return surface;
  surface.driver = kDrivers[kind->index];
  if (kind->body == nullptr) {
    if (surface.driver != "mock")
      report.error(tree, "what its controls do is not said",
                   "{" + surface.driver + ": {map: generic/wall-box}}");
    return surface;
  }
  Section section(*kind->body, "a surface", report);
  read_map(section, surface, context);
  surface.midi_name = surface.map.midi_name;
  surface.device.vendor = surface.map.vendor;
  surface.device.product = surface.map.product;
  if (surface.driver == "midi") into(surface.midi_name, text(section.find("name"), report));
  if (surface.driver == "hid" && (section.has("device") || section.has("usb") ||
                                  section.has("serial") || section.has("path"))) {
    const DeviceName named = read_device(section, report);
    if (named.vendor != 0) surface.device = named;
    surface.device.node = named.node;
    surface.device.serial = named.serial;
    surface.device.usb_path = named.usb_path;
  }
  if (surface.driver == "osc") {
    into(surface.interface, text(section.need("interface", "eth0"), report));
    into(surface.port, whole(section.find("port"), 1, 65535, report));
  }
  std::string chip;
  if (surface.driver == "gpio") into(chip, text(section.find("chip"), report));
  for (SurfaceControl& control : surface.map.controls)
    if (!chip.empty()) control.chip = chip;
  read_own_deeds(section.find("do"), surface, report);
  section.refuse_unknown();
  check_lamps(surface, studio, report);
  return surface;
}

/// One socket and one device cannot serve two.
void check_shared(const Studio& studio, Report& report) {
  for (std::size_t i = 0; i < studio.surfaces.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Surface &a = studio.surfaces[i], &b = studio.surfaces[k];
      if (a.driver != "osc" || b.driver != "osc" || a.port != b.port) continue;
      report.add({a.place,
                  "surfaces " + in_quotes(a.name) + " and " + in_quotes(b.name) +
                      " both listen on port " + std::to_string(a.port),
                  "give one of them another: port: " + std::to_string(a.port + 1), false});
    }
}

}  // namespace

void read_surfaces(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("surfaces");
  if (tree == nullptr) return;
  Section section(*tree, "surfaces", context.report);
  for (std::size_t i = 0; section.valid() && i < tree->keys.size(); ++i) {
    check_name(tree->keys[i], context);
    studio.surfaces.push_back(read_surface(tree->keys[i], tree->items[i], studio, context));
  }
  check_shared(studio, context.report);
}

}  // namespace chiaro::studio::sections
