// SPDX-License-Identifier: Apache-2.0
// ranges: what the raw values of a channel mean, lowest first.
#include <cmath>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"

namespace chiaro::studio::profiles {

using namespace reading;

namespace {

/// The file's value of what the channel carries, with its unit where it has one; inside units. A
/// trim is a difference: its kelvin start near 0.
std::optional<double> physical(const Tree* tree, const Channel& channel, Report& report) {
  constexpr core::Range kTurn{-8 * core::kPi, 8 * core::kPi};
  if (!channel.dof) return quantity(tree, Measure::frequency, {0, 1e6}, report);
  switch (core::info(*channel.dof).unit) {
    case core::Unit::degrees:
      return quantity(tree, Measure::angle, kTurn, report);
    case core::Unit::metres:
      return quantity(tree, Measure::length, {0, kFar}, report);
    case core::Unit::kelvin:
      return quantity(
          tree, Measure::temperature,
          channel.use == ChannelUse::trims ? core::Range{-5000, 5000} : core::Range{1000, 25000},
          report);
    case core::Unit::none:
      break;
  }
  return channel.dof == core::Dof::tint ? number(tree, {-50, 50}, report) : fraction(tree, report);
}

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
    into(segment.physical_from, physical(neutral, channel, report));
    segment.physical_to = segment.physical_from;
  }
  if (means != nullptr) {
    // May run downwards: many lamps count their colour temperature backwards.
    if (means->kind != Tree::Kind::sequence || means->items.size() != 2) {
      report.error(*means, "'means' needs two values", "the first for the lower end of 'dmx'");
      return std::nullopt;
    }
    into(segment.physical_from, physical(means->items.data(), channel, report));
    into(segment.physical_to, physical(&means->items[1], channel, report));
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

}  // namespace

double full_scale(int bytes) { return std::exp2(8 * bytes) - 1; }

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

}  // namespace chiaro::studio::profiles
