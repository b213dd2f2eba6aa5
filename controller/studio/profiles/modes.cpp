// SPDX-License-Identifier: Apache-2.0
// modes: name: [channel, …], slot after slot, and what must hold between the channels of one mode.
#include <algorithm>
#include <array>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::profiles {

using namespace reading;

std::optional<core::Range> own_range(const Profile& profile, core::Dof dof) {
  const Emitter& emitter = profile.emitter;
  const bool bicolour = emitter.has_white_mix();
  if (dof == core::Dof::intensity) return core::Range{0, 1};
  if (dof == core::Dof::cct && bicolour) return emitter.cct_range;
  if (dof == core::Dof::tint && bicolour && emitter.tint_range.width() > 0)
    return emitter.tint_range;
  if (dof == core::Dof::crossfade && emitter.kind == Emitter::Kind::blend) return core::Range{0, 1};
  if (dof == core::Dof::zoom && profile.zoom.width() > 0) return profile.zoom;
  if (dof == core::Dof::pan && profile.pan.width() > 0) return profile.pan;
  if (dof == core::Dof::tilt && profile.tilt.width() > 0) return profile.tilt;
  for (const Primary& primary : emitter.primaries)
    if (primary.dof == dof) return core::Range{0, 1};
  return std::nullopt;
}

namespace {

void refuse_shared_slots(const Tree& where, const Mode& mode, Report& report) {
  std::array<bool, 520> taken{};
  for (const Channel& channel : mode.channels)
    for (int byte = 0; byte < channel.bytes; ++byte) {
      const int slot = channel.slot(byte);
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
    if (!channel.dof || channel.use != ChannelUse::controls) continue;
    if (seen[core::index_of(*channel.dof)])
      report.error(where,
                   "two channels of this mode control " + in_quotes(core::info(*channel.dof).name),
                   "write a fine channel as one channel with bits: 16");
    seen[core::index_of(*channel.dof)] = true;
  }
}

/// A trim is added to something, and a repetition repeats something.
void refuse_followers_alone(const Tree& where, const Mode& mode, Report& report) {
  std::array<int, core::kDofs> trims{};
  for (const Channel& channel : mode.channels) {
    if (!channel.dof || channel.use == ChannelUse::controls) continue;
    const std::string name = in_quotes(core::info(*channel.dof).name);
    const bool led = std::any_of(mode.channels.begin(), mode.channels.end(), [&](const Channel& c) {
      return c.use == ChannelUse::controls && c.dof == channel.dof;
    });
    if (!led)
      report.error(where, "no channel of this mode controls " + name + ", yet one follows it",
                   "write {controls: …} for the first or coarse one");
    if (channel.use == ChannelUse::trims && ++trims[core::index_of(*channel.dof)] == 2)
      report.error(where, "two channels of this mode trim " + name, "one coarse, one trim");
  }
}

Mode read_mode(const std::string& name, const Tree& tree, const Profile& profile, Report& report) {
  Mode mode{name, 0, {}};
  if (tree.kind != Tree::Kind::sequence || tree.items.empty() || tree.items.size() > 512) {
    report.error(tree, "a mode needs a list of its channels", "- {controls: intensity}");
    return mode;
  }
  for (const Tree& item : tree.items) {
    const Channel* last = mode.channels.empty() ? nullptr : &mode.channels.back();
    const int next = last == nullptr ? 0 : last->slot(last->bytes - 1) + 1;
    mode.channels.push_back(read_channel(item, next, profile, report));
    for (int byte = 0; byte < mode.channels.back().bytes; ++byte)
      mode.footprint = std::max(mode.footprint, mode.channels.back().slot(byte) + 1);
  }
  if (mode.footprint > 512)
    report.error(tree, "this mode takes " + std::to_string(mode.footprint) + " slots",
                 "a universe has 512");
  refuse_shared_slots(tree, mode, report);
  refuse_twice_controlled(tree, mode, report);
  refuse_followers_alone(tree, mode, report);
  // A lamp that is always on may still be aimed.
  const bool serves = std::any_of(mode.channels.begin(), mode.channels.end(), [](const Channel& c) {
    return c.dof && (*c.dof == core::Dof::intensity || core::is_colour(*c.dof) ||
                     *c.dof == core::Dof::pan || *c.dof == core::Dof::tilt);
  });
  if (!serves)
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
