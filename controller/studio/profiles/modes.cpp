// SPDX-License-Identifier: Apache-2.0
// modes: name: [channel, …], slot after slot. A channel `controls` a degree of freedom or holds a
// `constant`; `ranges` says what its raw values mean where that is not simply least to most.
#include <algorithm>
#include <array>
#include <cmath>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::profiles {

using namespace reading;

std::optional<core::Range> own_range(const Profile& profile, core::Dof dof) {
  const Emitter& emitter = profile.emitter;
  const bool bicolour = emitter.kind == Emitter::Kind::bicolour;
  if (dof == core::Dof::intensity) return core::Range{0, 1};
  if (dof == core::Dof::cct && bicolour) return emitter.cct_range;
  if (dof == core::Dof::tint && bicolour && emitter.tint_range.width() > 0)
    return emitter.tint_range;
  if (dof == core::Dof::zoom && profile.zoom.width() > 0) return profile.zoom;
  for (const Primary& primary : emitter.primaries)
    if (primary.dof == dof) return core::Range{0, 1};
  return std::nullopt;
}

namespace {

/// The file's value of a degree of freedom, with its unit where it has one; inside units.
std::optional<double> physical(const Tree* tree, core::Dof dof, Report& report) {
  constexpr core::Range kTurn{-4 * core::kPi, 4 * core::kPi};
  switch (core::info(dof).unit) {
    case core::Unit::degrees:
      return quantity(tree, Measure::angle, kTurn, report);
    case core::Unit::metres:
      return quantity(tree, Measure::length, {0, kFar}, report);
    case core::Unit::kelvin:
      return quantity(tree, Measure::temperature, {1000, 25000}, report);
    case core::Unit::none:
      break;
  }
  return dof == core::Dof::tint ? number(tree, {-50, 50}, report) : fraction(tree, report);
}

double full_scale(int bytes) { return std::exp2(8 * bytes) - 1; }

/// One line of `ranges`: {dmx: [0, 10], means: [2700 K, 6500 K]}, {…, neutral: 0} or {…,
/// no_effect}.
std::optional<Segment> read_segment(const Tree& tree, const Channel& channel, Report& report) {
  Section section(tree, "a range of a channel", report);
  const double full = full_scale(channel.bytes);
  const auto dmx = number_span(section.need("dmx", "[0, 255]"), {0, full}, report);
  const Tree* means = section.find("means");
  const Tree* neutral = section.find("neutral");
  const Tree* nothing = section.find("no_effect");
  section.refuse_unknown();
  if ((means != nullptr) + (neutral != nullptr) + (nothing != nullptr) != 1) {
    report.error(tree, "a range needs one of means, neutral or no_effect",
                 "for example {dmx: [0, 255], means: [2700 K, 6500 K]}");
    return std::nullopt;
  }
  Segment segment;
  if (dmx) {
    segment.dmx_from = dmx->least / full;
    segment.dmx_to = dmx->most / full;
  }
  if (nothing != nullptr) segment.law = Segment::Law::no_effect;
  if (neutral != nullptr) {
    segment.law = Segment::Law::neutral;
    into(segment.physical_from, physical(neutral, *channel.dof, report));
    segment.physical_to = segment.physical_from;
  }
  if (means != nullptr) {
    // May run downwards: many lamps count their colour temperature backwards.
    if (means->kind != Tree::Kind::sequence || means->items.size() != 2) {
      report.error(*means, "'means' needs two values", "the first for the lower end of 'dmx'");
      return std::nullopt;
    }
    into(segment.physical_from, physical(means->items.data(), *channel.dof, report));
    into(segment.physical_to, physical(&means->items[1], *channel.dof, report));
  }
  return segment;
}

bool rises_or_falls_throughout(const std::vector<Segment>& segments) {
  int direction = 0;
  double last = 0;
  bool first = true;
  const auto step = [&](double to) {
    const int now = first || to == last ? 0 : to > last ? 1 : -1;
    first = false;
    last = to;
    if (now != 0 && direction != 0 && now != direction) return false;
    if (now != 0) direction = now;
    return true;
  };
  for (const Segment& s : segments)
    if (s.law == Segment::Law::continuous && (!step(s.physical_from) || !step(s.physical_to)))
      return false;
  return true;
}

void read_ranges(const Tree& tree, Channel& channel, Report& report) {
  if (tree.kind != Tree::Kind::sequence || tree.items.empty()) {
    report.error(tree, "'ranges' needs a list", "- {dmx: [0, 255], means: [2700 K, 6500 K]}");
    return;
  }
  for (const Tree& item : tree.items)
    if (const auto segment = read_segment(item, channel, report)) {
      if (!channel.segments.empty() && segment->dmx_from <= channel.segments.back().dmx_to)
        report.error(item, "this range overlaps the one before, or stands below it",
                     "list the ranges from the lowest raw value to the highest");
      channel.segments.push_back(*segment);
    }
  if (!rises_or_falls_throughout(channel.segments))
    report.error(tree, "the meaning of this channel goes up and down",
                 "it must only rise or only fall, else one wish has two raw values");
}

void read_meaning(const Tree& tree, Section& section, const Profile& profile, Channel& channel,
                  Report& report) {
  const Tree* ranges = section.find("ranges");
  if (ranges != nullptr) return read_ranges(*ranges, channel, report);
  const auto range = own_range(profile, *channel.dof);
  if (range) {
    channel.segments = {{0, 1, range->least, range->most, Segment::Law::continuous}};
  } else {
    report.error(
        tree,
        "what the raw values of " + in_quotes(core::info(*channel.dof).name) + " mean is not known",
        "add ranges: [{dmx: [0, 255], means: [from, to]}], or give the lamp that setting");
  }
}

void read_controls(const Tree& tree, const Tree& controls, Section& section, const Profile& profile,
                   Channel& channel, Report& report) {
  std::vector<std::pair<std::string, core::Dof>> dofs;
  for (const core::DofInfo& dof : core::dofs())
    if (dof.dof != core::Dof::azimuth && dof.dof != core::Dof::elevation &&
        dof.dof != core::Dof::distance)
      dofs.emplace_back(dof.name, dof.dof);
  channel.dof = choice<core::Dof>(&controls, dofs, report);
  if (!channel.dof) return;
  if (channel.name.empty()) channel.name = core::info(*channel.dof).name;
  read_meaning(tree, section, profile, channel, report);
}

Channel read_channel(const Tree& tree, int next_slot, const Profile& profile, Report& report) {
  Section section(tree, "a channel", report);
  Channel channel;
  into(channel.name, text(section.find("name"), report));
  if (const auto bits = choice<int>(section.find("bits"), {{"8", 1}, {"16", 2}, {"24", 3}}, report))
    channel.bytes = *bits;
  const auto slot = whole(section.find("slot"), 1, 512, report);
  channel.offset = slot ? static_cast<int>(*slot) - 1 : next_slot;
  const Tree* controls = section.find("controls");
  const Tree* constant = section.find("constant");
  if (section.valid() && (controls == nullptr) == (constant == nullptr)) {
    report.error(tree, "a channel needs either 'controls' or 'constant'",
                 "controls: intensity, or constant: 0 for a channel that never changes");
  } else if (controls != nullptr) {
    read_controls(tree, *controls, section, profile, channel, report);
  } else if (constant != nullptr) {
    const auto raw =
        whole(constant, 0, static_cast<std::int64_t>(full_scale(channel.bytes)), report);
    if (raw) channel.constant = static_cast<double>(*raw) / full_scale(channel.bytes);
  }
  section.refuse_unknown();
  return channel;
}

void refuse_shared_slots(const Tree& where, const Mode& mode, Report& report) {
  std::array<bool, 520> taken{};
  for (const Channel& channel : mode.channels)
    for (int slot = channel.offset; slot < channel.offset + channel.bytes; ++slot) {
      bool& used = taken[static_cast<std::size_t>(std::min(slot, 519))];
      if (used)
        report.error(where, "two channels of this mode share slot " + std::to_string(slot + 1),
                     "a 16 bit channel takes two slots, a 24 bit channel three");
      used = true;
    }
}

void refuse_twice_controlled(const Tree& where, const Mode& mode, Report& report) {
  std::array<bool, core::kDofs> seen{};
  for (const Channel& channel : mode.channels) {
    if (!channel.dof) continue;
    if (seen[core::index_of(*channel.dof)])
      report.error(where,
                   "two channels of this mode control " + in_quotes(core::info(*channel.dof).name),
                   "write a fine channel as one channel with bits: 16");
    seen[core::index_of(*channel.dof)] = true;
  }
}

Mode read_mode(const std::string& name, const Tree& tree, const Profile& profile, Report& report) {
  Mode mode{name, 0, {}};
  if (tree.kind != Tree::Kind::sequence || tree.items.empty() || tree.items.size() > 512) {
    report.error(tree, "a mode needs a list of its channels", "- {controls: intensity}");
    return mode;
  }
  for (const Tree& item : tree.items) {
    const int next =
        mode.channels.empty() ? 0 : mode.channels.back().offset + mode.channels.back().bytes;
    mode.channels.push_back(read_channel(item, next, profile, report));
    mode.footprint =
        std::max(mode.footprint, mode.channels.back().offset + mode.channels.back().bytes);
  }
  if (mode.footprint > 512)
    report.error(tree, "this mode takes " + std::to_string(mode.footprint) + " slots",
                 "a universe has 512");
  refuse_shared_slots(tree, mode, report);
  refuse_twice_controlled(tree, mode, report);
  const bool lights = std::any_of(mode.channels.begin(), mode.channels.end(), [](const Channel& c) {
    return c.dof && (*c.dof == core::Dof::intensity || core::is_colour(*c.dof));
  });
  if (!lights)
    report.error(tree, "no channel of this mode controls light",
                 "add {controls: intensity}, or a colour of a mixed emitter");
  return mode;
}

}  // namespace

std::vector<Mode> read_modes(const Tree* tree, const Profile& profile, Report& report) {
  std::vector<Mode> modes;
  if (tree == nullptr) return modes;
  if (tree->kind != Tree::Kind::mapping || tree->keys.empty()) {
    report.error(*tree, "'modes' needs at least one mode", "1ch: [{controls: intensity}]");
    return modes;
  }
  for (std::size_t i = 0; i < tree->keys.size(); ++i)
    modes.push_back(read_mode(tree->keys[i].text, tree->items[i], profile, report));
  return modes;
}

}  // namespace chiaro::studio::profiles
