// SPDX-License-Identifier: Apache-2.0
// mount: {fixed: …}, {stand: …}, {arc: …}, {track: …}, {pan_tilt: …} or {virtual: …}.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

constexpr core::Range kAzimuth{-core::kPi, core::kPi};
constexpr core::Range kElevation{-core::kPi / 2, core::kPi / 2};
constexpr core::Range kDistance{0.05, kFar};

void read_at_and_aim(Section& section, core::Vec3& at, core::Vec3& aim_at, Report& report) {
  const auto from = point(section.need("at", "[-0.8, 1.1, 2.3]"), report);
  const auto to = point(section.need("aim_at", "[0, 0, 1.4]"), report);
  into(at, from);
  into(aim_at, to);
  if (from && to && core::distance(*from, *to) < 1e-3)
    report.error(section.tree(), "the lamp is aimed at the point where it hangs", "move 'aim_at'");
}

Mount read_fixed(const Tree& tree, Report& report) {
  Section section(tree, "a fixed mount", report);
  FixedMount mount;
  read_at_and_aim(section, mount.at, mount.aim_at, report);
  section.refuse_unknown();
  return mount;
}

/// neutral: {pan: 15 deg, tilt: -40 deg} - what the head itself shows when it aims at `aim_at`.
void read_neutral(const Tree* tree, PanTiltMount& mount, Report& report) {
  if (tree == nullptr) return;
  constexpr core::Range kTurn{-4 * core::kPi, 4 * core::kPi};
  Section section(*tree, "a head's neutral angles", report);
  into(mount.head_pan, quantity(section.need("pan", "0 deg"), Measure::angle, kTurn, report));
  into(mount.head_tilt, quantity(section.need("tilt", "45 deg"), Measure::angle, kTurn, report));
  section.refuse_unknown();
}

Mount read_pan_tilt(const Tree& tree, Report& report) {
  Section section(tree, "a pan_tilt mount", report);
  PanTiltMount mount;
  read_at_and_aim(section, mount.at, mount.aim_at, report);
  constexpr core::Range kTurn{-4 * core::kPi, 4 * core::kPi};
  into(mount.pan, span(section.find("pan"), Measure::angle, kTurn, report));
  into(mount.tilt, span(section.find("tilt"), Measure::angle, kTurn, report));
  read_neutral(section.find("neutral"), mount, report);
  into(mount.invert_pan, yes_or_no(section.find("invert_pan"), report));
  into(mount.invert_tilt, yes_or_no(section.find("invert_tilt"), report));
  into(mount.swap, yes_or_no(section.find("swap"), report));
  section.refuse_unknown();
  return mount;
}

std::optional<core::Spherical> read_place(const Tree* tree, Report& report) {
  if (tree == nullptr) return std::nullopt;
  Section section(*tree, "a place about the subject", report);
  const auto azimuth =
      quantity(section.need("azimuth", "-45 deg"), Measure::angle, kAzimuth, report);
  const auto elevation =
      quantity(section.need("elevation", "35 deg"), Measure::angle, kElevation, report);
  const auto distance =
      quantity(section.need("distance", "1.8 m"), Measure::length, kDistance, report);
  section.refuse_unknown();
  if (!azimuth || !elevation || !distance) return std::nullopt;
  return core::Spherical{*azimuth, *elevation, *distance};
}

void read_region(Section& section, Region& region, Report& report) {
  into(region.azimuth, span(section.find("azimuth"), Measure::angle, kAzimuth, report));
  into(region.elevation, span(section.find("elevation"), Measure::angle, kElevation, report));
  into(region.distance, span(section.find("distance"), Measure::length, kDistance, report));
}

void check_inside(const Tree* at, const core::Spherical& place, const Region& region,
                  Report& report) {
  const auto check = [&](const char* name, double value, core::Range range, Measure measure) {
    // A degree written twice must not differ by its rounding to radians.
    if (value >= range.least - 1e-9 && value <= range.most + 1e-9) return;
    report.error(*at,
                 "the lamp stands outside its own region: " + std::string(name) + " " +
                     written(measure, value) + " is not within " + written(measure, range.least) +
                     " to " + written(measure, range.most),
                 "move 'at', or widen '" + std::string(name) + "'");
  };
  check("azimuth", place.azimuth, region.azimuth, Measure::angle);
  check("elevation", place.elevation, region.elevation, Measure::angle);
  check("distance", place.distance, region.distance, Measure::length);
}

Mount read_stand(const Tree& tree, Report& report) {
  Section section(tree, "a stand", report);
  StandMount mount;
  const Tree* at = section.need("at", "{azimuth: -45 deg, elevation: 35 deg, distance: 1.8 m}");
  const auto place = read_place(at, report);
  read_region(section, mount.region, report);
  section.refuse_unknown();
  if (place) {
    mount.at = *place;
    check_inside(at, *place, mount.region, report);
  }
  return mount;
}

Mount read_virtual(const Tree* tree, Report& report) {
  VirtualMount mount;
  if (tree == nullptr) return mount;
  Section section(*tree, "a virtual mount", report);
  const Tree* at = section.find("at");
  const auto place = read_place(at, report);
  if (place) {
    mount.at = *place;
    mount.region.distance = {place->distance, place->distance};
  }
  read_region(section, mount.region, report);
  if (!place && !mount.region.distance.contains(mount.at.distance))
    mount.at.distance = mount.region.distance.clamp(mount.at.distance);
  into(mount.separate_specular, yes_or_no(section.find("separate_specular"), report));
  section.refuse_unknown();
  if (place) check_inside(at, *place, mount.region, report);
  return mount;
}

/// axis: {channel: 3} of the lamp's own patch, or {universe: 9, address: 1} of a motor's own.
AxisWire read_axis(const Tree* tree, Context& context) {
  AxisWire axis;
  if (tree == nullptr) return axis;
  Report& report = context.report;
  Section section(*tree, "an axis", report);
  const Tree* channel = section.find("channel");
  const Tree* universe = section.find("universe");
  const Tree* bus = section.find("modbus");
  const Tree* bits = section.find("bits");
  into(axis.bytes, choice<int>(bits, {{"8", 1}, {"16", 2}}, report));
  if (bus != nullptr) {
    (void)section.find("register");
    report.error(*tree, "a motor on a bus is reached through a universe of its own",
                 "outputs: {universe 9: {modbus: {bus: …, unit: 1, map: generic/positioner}}}, "
                 "and here axis: {universe: 9, address: 1}");
  } else if (section.valid() && (channel == nullptr) == (universe == nullptr)) {
    report.error(*tree, "an axis needs either a channel or an address of its own",
                 "{channel: 3} counts in the lamp's patch, or {universe: 9, address: 1}");
  } else if (channel != nullptr) {
    into(axis.slot, whole(channel, 1, 512, report));
  } else if (universe != nullptr) {
    if (bits == nullptr) axis.bytes = 2;
    into(axis.universe, whole(universe, 1, 63999, report));
    into(axis.slot, whole(section.need("address", "1"), 1, 513 - axis.bytes, report));
  }
  section.refuse_unknown();
  return axis;
}

Mount read_arc(const Tree& tree, Context& context) {
  Report& report = context.report;
  Section section(tree, "an arc", report);
  ArcMount arc;
  constexpr core::Range kTurn{-2 * core::kPi, 2 * core::kPi};
  into(arc.centre, point(section.need("centre", "[0, 0, 1.4]"), report));
  into(arc.radius, quantity(section.need("radius", "1.8 m"), Measure::length, kDistance, report));
  const auto angle =
      span(section.need("angle", "[-80 deg, 80 deg]"), Measure::angle, kTurn, report);
  const Tree* at_tree = section.need("at", "-45 deg");
  const auto at = quantity(at_tree, Measure::angle, kTurn, report);
  into(arc.angle, angle);
  into(arc.at, at);
  if (at && angle && !angle->contains(*at))
    report.error(*at_tree, "the lamp stands outside its own arc", "move 'at', or widen 'angle'");
  into(arc.vertical,
       choice<bool>(section.find("plane"), {{"horizontal", false}, {"vertical", true}}, report));
  arc.axis = read_axis(section.need("axis", "{channel: 3}"), context);
  section.refuse_unknown();
  return arc;
}

Mount read_track(const Tree& tree, Context& context) {
  Report& report = context.report;
  Section section(tree, "a track", report);
  TrackMount track;
  const auto from = point(section.need("from", "[-2, -1, 2.5]"), report);
  const auto to = point(section.need("to", "[2, -1, 2.5]"), report);
  into(track.from, from);
  into(track.to, to);
  if (from && to && core::distance(*from, *to) < 1e-3)
    report.error(tree, "the track has no length", "move 'from' or 'to'");
  into(track.at, fraction(section.need("at", "50 %"), report));
  track.axis = read_axis(section.need("axis", "{channel: 3}"), context);
  section.refuse_unknown();
  return track;
}

}  // namespace

Mount read_mount(const Tree* tree, Context& context) {
  Report& report = context.report;
  const std::vector<std::string> names{"fixed", "stand", "arc", "track", "pan_tilt", "virtual"};
  const auto kind = variant(tree, "a kind of mount", names, report);
  if (!kind) return FixedMount{{0, -1, 2}, {0, 0, 1}};
  if (kind->index == 5) return read_virtual(kind->body, report);
  if (kind->body == nullptr) {
    report.error(*tree, "this mount lacks its place",
                 "mount: {" + names[kind->index] + ": {at: …}}");
    return FixedMount{{0, -1, 2}, {0, 0, 1}};
  }
  switch (kind->index) {
    case 0:
      return read_fixed(*kind->body, report);
    case 1:
      return read_stand(*kind->body, report);
    case 2:
      return read_arc(*kind->body, context);
    case 3:
      return read_track(*kind->body, context);
    default:
      return read_pan_tilt(*kind->body, report);
  }
}

}  // namespace chiaro::studio::sections
