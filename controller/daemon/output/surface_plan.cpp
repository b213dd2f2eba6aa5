// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/surface_plan.h"

#include <array>
#include <cmath>

namespace chiaro::daemon {
namespace {

using studio::Deed;
using studio::Shown;

drivers::SurfaceControl control_of(const studio::SurfaceControl& control) {
  drivers::SurfaceControl one{.name = control.name};
  one.kind = static_cast<drivers::SurfaceControl::Kind>(control.kind);
  one.midi = static_cast<drivers::SurfaceControl::Midi>(control.midi);
  one.channel = static_cast<std::uint8_t>(control.channel);
  one.number = static_cast<std::uint8_t>(control.number);
  one.byte = control.byte;
  one.bit = control.bit;
  one.bytes = control.bytes;
  one.most = control.most;
  one.lamp_byte = control.lamp_byte;
  one.lamp_bit = control.lamp_bit;
  one.osc = control.osc;
  if (control.line >= 0)
    one.gpio = {control.chip, static_cast<unsigned>(control.line), control.output,
                control.active_low, control.pull_up};
  one.debounce = std::chrono::milliseconds(std::lround(1000 * control.debounce_s));
  return one;
}

rig::Mark mark_named(const std::string& name) {
  constexpr std::array kMarks{rig::Mark::highlight, rig::Mark::flash, rig::Mark::solo,
                              rig::Mark::park};
  for (const rig::Mark mark : kMarks)
    if (rig::name_of(mark) == name) return mark;
  return rig::Mark::move_in_black;
}

Act::Press press_of(Deed::Press press) {
  switch (press) {
    case Deed::Press::on:
      return Act::Press::latch;
    case Deed::Press::off:
      return Act::Press::clear;
    case Deed::Press::follow:
      return Act::Press::follow;
    case Deed::Press::toggle:
      break;
  }
  return Act::Press::toggle;
}

Act::Kind kind_of(Deed::Kind kind) {
  switch (kind) {
    case Deed::Kind::blackout:
      return Act::Kind::blackout;
    case Deed::Kind::motion_stop:
      return Act::Kind::motion_stop;
    case Deed::Kind::motion_arm:
      return Act::Kind::motion_arm;
    case Deed::Kind::blind:
      return Act::Kind::blind;
    case Deed::Kind::mark:
      return Act::Kind::mark;
    case Deed::Kind::release:
      return Act::Kind::release;
    case Deed::Kind::master:
      return Act::Kind::master;
    case Deed::Kind::level:
      return Act::Kind::level;
    case Deed::Kind::cue_go:
      return Act::Kind::cue_go;
    case Deed::Kind::cue_back:
      return Act::Kind::cue_back;
    case Deed::Kind::cue_off:
      return Act::Kind::cue_off;
    case Deed::Kind::cue_to:
      return Act::Kind::cue_to;
    case Deed::Kind::look:
    case Deed::Kind::mood:
    case Deed::Kind::nudge:
      return Act::Kind::ask;
  }
  return Act::Kind::none;
}

Act act_of(const Deed& deed, std::uint32_t& asked) {
  Act act;
  if (studio::needs_brain(deed.kind)) act.asked = asked++;
  act.kind = kind_of(deed.kind);
  act.press = press_of(deed.press);
  act.master = static_cast<rig::Master>(deed.master);
  act.fixture = deed.lamp;
  act.dof = deed.dof;
  act.mark = mark_named(deed.name);
  act.cue = deed.amount;
  act.step = deed.step;
  return act;
}

Tally tally_of(Shown::Kind kind) {
  switch (kind) {
    case Shown::Kind::nothing:
      return Tally::none;
    case Shown::Kind::blackout:
      return Tally::blackout;
    case Shown::Kind::motion_stop:
      return Tally::motion_stopped;
    case Shown::Kind::motion_arm:
      return Tally::motion_armed;
    case Shown::Kind::cue:
      return Tally::cue;
    case Shown::Kind::master:
      return Tally::master;
    case Shown::Kind::level:
      return Tally::level;
    case Shown::Kind::lit:
      return Tally::lit;
    case Shown::Kind::mark:
      return Tally::marked;
    case Shown::Kind::holding:
      return Tally::holding;
    case Shown::Kind::trouble:
      return Tally::fault;
  }
  return Tally::none;
}

/// What a control shows, with an act that does nothing but say whose level, mark or master it is.
BoundControl shown_by(const studio::SurfaceControl& control) {
  Act about;
  about.master = static_cast<rig::Master>(control.shown.master);
  about.fixture = control.shown.lamp;
  about.dof = control.shown.dof;
  about.mark = mark_named(control.shown.name);
  return {control.name, about, tally_of(control.shown.kind)};
}

/// The first thing that a control does, when that is also what it shows: one cue alone is lit by
/// the act that calls it.
bool shows_its_act(const studio::SurfaceControl& control) {
  return control.shown.kind == Shown::Kind::cue && control.shown.cue >= 0;
}

/// `asked`: how many deeds before this surface's are the brain's; counted on.
SurfacePlan plan_of(const studio::Surface& surface, std::uint32_t& asked) {
  SurfacePlan plan;
  plan.name = surface.name;
  plan.driver = surface.driver;
  const auto& device = surface.device;
  plan.settings.device = {
      device.node, device.vendor, device.product, device.serial, device.usb_path, "", ""};
  plan.settings.midi_name = surface.midi_name;
  plan.settings.interface = surface.interface;
  plan.settings.port = surface.port;
  plan.settings.report_size = surface.map.report_size;
  plan.settings.report_number = static_cast<std::uint8_t>(surface.map.report_number);
  for (const auto& control : surface.map.controls) {
    plan.settings.controls.push_back(control_of(control));
    for (const Deed& deed : control.deeds)
      plan.controls.push_back({control.name, act_of(deed, asked), Tally::none});
    if (shows_its_act(control))
      plan.controls[plan.controls.size() - control.deeds.size()].tally = Tally::cue;
    else if (control.shown.kind != Shown::Kind::nothing)
      plan.controls.push_back(shown_by(control));
  }
  return plan;
}

}  // namespace

std::vector<SurfacePlan> surface_plans(const studio::Studio& studio) {
  std::vector<SurfacePlan> plans;
  std::uint32_t asked = 0;
  for (const auto& surface : studio.surfaces) plans.push_back(plan_of(surface, asked));
  return plans;
}

}  // namespace chiaro::daemon
