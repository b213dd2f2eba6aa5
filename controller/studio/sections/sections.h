// SPDX-License-Identifier: Apache-2.0
// The sections of a studio file, one reader and one file each. A reader reports what is wrong and
// gives the best value it can, so that the rest of the file is still read.
#pragma once

#include <string>
#include <vector>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/studio.h"

namespace chiaro::studio::sections {

using reading::Context;
using reading::Section;
using reading::Tree;

void read_subjects(Section& top, Context& context, Studio& studio);
void read_background(Section& top, Context& context, Studio& studio);
void read_cameras(Section& top, Context& context, Studio& studio);
void read_exposure(Section& top, Context& context, Studio& studio);
void read_ambient(Section& top, Context& context, Studio& studio);
void read_safety(Section& top, Context& context, Studio& studio);
void read_buses(Section& top, Context& context, Studio& studio);
/// After buses.
void read_outputs(Section& top, Context& context, Studio& studio);
/// Parts of outputs and buses: device: /dev/…, usb: "0403:6001", serial: …, path: "1-1.4". One of
/// them at least: an adapter that nobody named may be somebody else's.
DeviceName read_device(Section& section, reading::Report& report);
ModbusOutput read_modbus_output(const Tree& tree, const Studio& studio, Context& context);
/// After exposure (colour that nobody sets starts at its white balance) and buses.
void read_fixtures(Section& top, Context& context, profiles::Shelf& shelf, Studio& studio);
/// After fixtures.
void read_circuits(Section& top, Context& context, Studio& studio);
void read_keep_out(Section& top, Context& context, Studio& studio);
/// After fixtures: their levels may be on faders.
void read_surfaces(Section& top, Context& context, Studio& studio);

/// Parts of a fixture.
Mount read_mount(const Tree* tree, Context& context);
Patch read_patch(const Tree* tree, const Studio& studio, Context& context);
std::vector<Modifier> read_modifiers(const Tree* tree, Context& context);
Limits read_limits(const Tree* tree, Context& context);
std::vector<HandBinding> read_by_hand(const Tree* tree, const Fixture& fixture, Context& context);
core::FixtureState read_initial(const Tree* tree, const Fixture& fixture, Context& context);
Material read_material(Section& section, const Material& otherwise, Context& context);

/// The bus of that name, else a report with the nearest one.
bool bus_exists(const Tree& where, const std::string& name, const Studio& studio, Context& context);

/// Names go into addresses, looks and messages: letters, digits, space, '-', '_' and '.'.
bool check_name(const Tree::Key& key, Context& context);

}  // namespace chiaro::studio::sections
