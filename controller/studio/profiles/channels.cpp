// SPDX-License-Identifier: Apache-2.0
// One channel of a mode: it `controls`, `trims` or `repeats` a degree of freedom, or is held at a
// `constant`, at `open` (shutters, strobes) or at the value for a `pwm` frequency.
#include <algorithm>
#include <array>
#include <cmath>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::profiles {

using namespace reading;

namespace {

struct Verb {
  const char* word;
  ChannelUse use;
};
constexpr std::array kVerbs{
    Verb{"controls", ChannelUse::controls}, Verb{"trims", ChannelUse::trims},
    Verb{"repeats", ChannelUse::repeats},   Verb{"constant", ChannelUse::constant},
    Verb{"open", ChannelUse::open},         Verb{"pwm", ChannelUse::pwm}};

/// What a mount alone can give is not on a lamp's own channels.
bool on_a_lamp(core::Dof dof) {
  return !core::is_placement(dof) || dof == core::Dof::pan || dof == core::Dof::tilt ||
         dof == core::Dof::zoom;
}

void read_meaning(const Tree& tree, Section& section, const Profile& profile, Channel& channel,
                  Report& report) {
  const Tree* ranges = section.find("ranges");
  if (ranges != nullptr) return read_ranges(*ranges, channel, report);
  const auto range = own_range(profile, *channel.dof);
  if (range && channel.use != ChannelUse::trims) {
    channel.segments = {{0, 1, range->least, range->most, Segment::Law::continuous}};
  } else {
    report.error(
        tree,
        "what the raw values of " + in_quotes(core::info(*channel.dof).name) + " mean is not known",
        channel.use == ChannelUse::trims
            ? "add ranges: [{dmx: [0, 255], means: [0 K, 255 K]}]: what is added"
            : "add ranges: [{dmx: [0, 255], means: [from, to]}], or give the lamp that setting");
  }
}

void read_dof(const Tree& tree, const Tree& verb, Section& section, const Profile& profile,
              Channel& channel, Report& report) {
  std::vector<std::pair<std::string, core::Dof>> dofs;
  for (const core::DofInfo& dof : core::dofs())
    if (on_a_lamp(dof.dof) && dof.dof != core::Dof::specular) dofs.emplace_back(dof.name, dof.dof);
  channel.dof = choice<core::Dof>(&verb, dofs, report);
  const Tree* rest = section.find("rest");
  if (!channel.dof) return;
  const double full = full_scale(channel.bytes);
  if (const auto raw = whole(rest, 0, static_cast<std::int64_t>(full), report))
    channel.rest = static_cast<double>(*raw) / full;
  if (channel.name.empty())
    channel.name = std::string(core::info(*channel.dof).name) +
                   (channel.use == ChannelUse::trims ? " trim" : "");
  read_meaning(tree, section, profile, channel, report);
}

void read_pwm(const Tree& tree, const Tree& verb, Section& section, Channel& channel,
              Report& report) {
  if (channel.name.empty()) channel.name = "pwm";
  const auto hertz = quantity(&verb, Measure::frequency, {1, 1e6}, report);
  const Tree* ranges = section.find("ranges");
  if (ranges == nullptr) {
    report.error(tree, "which raw values give which frequency is not known",
                 "add ranges: [{dmx: [0, 255], means: [600 Hz, 25000 Hz]}]");
    return;
  }
  read_ranges(*ranges, channel, report);
  if (!hertz || channel.segments.empty()) return;
  channel.constant = fraction_of(channel.segments, *hertz);
  channel.pwm_hz = meaning_of(channel.segments, channel.constant).value_or(*hertz);
}

void read_held(const Tree& verb, Channel& channel, Report& report) {
  const double full = full_scale(channel.bytes);
  if (channel.name.empty() && channel.use == ChannelUse::open) channel.name = "shutter";
  if (const auto raw = whole(&verb, 0, static_cast<std::int64_t>(full), report))
    channel.constant = static_cast<double>(*raw) / full;
}

/// slot: 4 for the first, or slots: [4, 9] where the bytes stand apart, most significant first.
void read_place(Section& section, int next_slot, Channel& channel, Report& report) {
  if (const auto bits = choice<int>(section.find("bits"), {{"8", 1}, {"16", 2}, {"24", 3}}, report))
    channel.bytes = *bits;
  const auto slot = whole(section.find("slot"), 1, 512, report);
  channel.offset = slot ? static_cast<int>(*slot) - 1 : next_slot;
  const Tree* slots = section.find("slots");
  if (slots == nullptr) return;
  if (section.has("bits") || section.has("slot") || slots->kind != Tree::Kind::sequence ||
      slots->items.empty() || slots->items.size() > 3) {
    report.error(*slots, "'slots' needs one to three slots, and stands for bits and slot",
                 "slots: [4, 9]: the most significant byte at the fourth slot");
    return;
  }
  channel.bytes = static_cast<int>(slots->items.size());
  for (std::size_t i = 0; i < slots->items.size(); ++i) {
    const auto one = whole(&slots->items[i], 1, 512, report);
    if (i == 0) channel.offset = one ? static_cast<int>(*one) - 1 : next_slot;
    if (i > 0) channel.finer.push_back(one ? static_cast<int>(*one) - 1 : next_slot);
  }
}

}  // namespace

Channel read_channel(const Tree& tree, int next_slot, const Profile& profile, Report& report) {
  Section section(tree, "a channel", report);
  Channel channel;
  into(channel.name, text(section.find("name"), report));
  read_place(section, next_slot, channel, report);
  const Tree* verb = nullptr;
  int verbs = 0;
  for (const Verb& each : kVerbs)
    if (const Tree* found = section.find(each.word)) {
      verb = found;
      channel.use = each.use;
      ++verbs;
    }
  if (section.valid() && verbs != 1) {
    report.error(tree, "a channel needs either 'controls' or 'constant'",
                 "controls: intensity, or constant: 0 for a channel that never changes; also "
                 "trims, repeats, open and pwm, one of them");
  } else if (verb != nullptr && channel.use <= ChannelUse::repeats) {
    read_dof(tree, *verb, section, profile, channel, report);
  } else if (verb != nullptr && channel.use == ChannelUse::pwm) {
    read_pwm(tree, *verb, section, channel, report);
  } else if (verb != nullptr) {
    read_held(*verb, channel, report);
  }
  section.refuse_unknown();
  return channel;
}

}  // namespace chiaro::studio::profiles
