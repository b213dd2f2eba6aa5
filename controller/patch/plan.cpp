// SPDX-License-Identifier: Apache-2.0
#include "controller/patch/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/patch/curve.h"

namespace chiaro::patch {
namespace {

using core::Dof;
using core::FixtureState;
using studio::Segment;

bool is_drive(Dof dof) { return core::is_colour(dof) && dof != Dof::cct && dof != Dof::tint; }

bool set_by_hand(const studio::Fixture& fixture, Dof dof) {
  return std::any_of(fixture.by_hand.begin(), fixture.by_hand.end(),
                     [&](const studio::HandBinding& b) { return b.dof == dof; });
}

bool has_channel(const studio::Mode& mode, Dof dof) {
  return std::any_of(mode.channels.begin(), mode.channels.end(),
                     [&](const studio::Channel& c) { return c.dof == dof; });
}

constexpr std::uint32_t full_scale(int bytes) {
  return (1u << (8u * static_cast<unsigned>(bytes))) - 1;
}

std::uint32_t raw_of(double fraction, int bytes) {
  return static_cast<std::uint32_t>(
      std::lround(std::clamp(fraction, 0.0, 1.0) * full_scale(bytes)));
}

/// The DMX fraction that means `value`, or the nearest that can be had.
double fraction_of(const std::vector<Segment>& segments, double value) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const Segment& s : segments) {
    if (s.law == Segment::Law::no_effect) continue;
    if (s.law == Segment::Law::neutral) {
      // The middle of a dead band, far from the meanings on either side.
      if (const double gap = std::abs(value - s.physical_from); gap < least)
        least = gap, best = 0.5 * (s.dmx_from + s.dmx_to);
      continue;
    }
    const auto [low, high] = std::minmax(s.physical_from, s.physical_to);
    const double near = std::clamp(value, low, high);
    if (const double gap = std::abs(value - near); gap < least) {
      const double width = s.physical_to - s.physical_from;
      const double x = width == 0 ? 0 : (near - s.physical_from) / width;
      least = gap, best = s.dmx_from + x * (s.dmx_to - s.dmx_from);
    }
  }
  return best;
}

/// The segment that holds `fraction`; between two of them the nearer.
const Segment* segment_at(const std::vector<Segment>& segments, double fraction) {
  const Segment* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : segments) {
    const double gap = std::abs(fraction - std::clamp(fraction, s.dmx_from, s.dmx_to));
    if (gap < least) least = gap, best = &s;
  }
  return best;
}

std::uint32_t raw_in(const ports::DmxFrame& frame, std::size_t first, int bytes) {
  std::uint32_t raw = 0;
  for (int i = 0; i < bytes; ++i)
    raw = raw << 8u | frame.levels[first + static_cast<std::size_t>(i)];
  return raw;
}

}  // namespace

Plan Plan::of(const studio::Studio& studio, core::Problems* warnings) {
  Plan plan;
  plan.fixtures_ = studio.fixtures.size();
  plan.no_dimmer_.assign(plan.fixtures_, 0);
  for (const auto& output : studio.outputs) plan.universes_.push_back(output.universe);
  for (const auto& fixture : studio.fixtures)
    if (const auto* dmx = std::get_if<studio::DmxPatch>(&fixture.patch))
      plan.universes_.push_back(dmx->universe);
  std::sort(plan.universes_.begin(), plan.universes_.end());
  plan.universes_.erase(std::unique(plan.universes_.begin(), plan.universes_.end()),
                        plan.universes_.end());
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const auto& fixture = studio.fixtures[i];
    plan.curves_.push_back(fixture.curve);
    if (std::holds_alternative<studio::DmxPatch>(fixture.patch)) plan.add(fixture, i);
    if (const auto* modbus = std::get_if<studio::ModbusPatch>(&fixture.patch);
        modbus != nullptr && warnings != nullptr)
      warnings->push_back({fixture.place,
                           "fixture '" + fixture.name + "' is patched to Modbus bus '" +
                               modbus->bus + "', for which there is no driver yet",
                           "set it by hand, or patch it to a DMX universe", true});
  }
  return plan;
}

void Plan::add(const studio::Fixture& fixture, std::size_t index) {
  const auto& patch = std::get<studio::DmxPatch>(fixture.patch);
  const auto& mode = fixture.profile.modes.at(fixture.mode);
  const bool no_dimmer =
      !has_channel(mode, Dof::intensity) &&
      std::any_of(mode.channels.begin(), mode.channels.end(),
                  [](const studio::Channel& c) { return c.dof && is_drive(*c.dof); });
  no_dimmer_[index] = no_dimmer ? 1 : 0;
  const auto universe = std::lower_bound(universes_.begin(), universes_.end(), patch.universe);
  for (const auto& channel : mode.channels) {
    Slot slot;
    slot.fixture = static_cast<std::uint32_t>(index);
    slot.universe = static_cast<std::uint32_t>(universe - universes_.begin());
    slot.first = static_cast<std::uint16_t>(patch.address - 1 + channel.offset);
    slot.bytes = static_cast<std::uint8_t>(channel.bytes);
    slot.name = channel.name;
    slot.curve = static_cast<std::uint32_t>(index);
    slot.segments = channel.segments;
    if (!channel.dof) {
      slot.constant = raw_of(channel.constant, channel.bytes);
    } else {
      slot.dof = *channel.dof;
      slot.law = set_by_hand(fixture, slot.dof)    ? Law::by_hand
                 : slot.dof == Dof::intensity      ? Law::level
                 : no_dimmer && is_drive(slot.dof) ? Law::dimmed_drive
                                                   : Law::segments;
    }
    if (slot.first + slot.bytes <= ports::kSlots) slots_.push_back(std::move(slot));
  }
}

std::vector<ports::DmxFrame> Plan::blank_frames() const {
  std::vector<ports::DmxFrame> frames(universes_.size());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].universe = universes_[i];
  return frames;
}

double Plan::drive(const Slot& slot, const FixtureState& state) const {
  const auto& curve = curves_[slot.curve];
  switch (slot.law) {
    case Law::level: {
      const double drive = drive_of_light(curve, state.get(Dof::intensity));
      return slot.segments.empty() ? drive : fraction_of(slot.segments, drive);
    }
    case Law::dimmed_drive: {
      const double light = state.get(slot.dof) * state.get(Dof::intensity);
      const double drive = drive_of_light(curve, light);
      return slot.segments.empty() ? drive : fraction_of(slot.segments, drive);
    }
    case Law::segments:
      if (!state.has(slot.dof)) return 0;
      return slot.segments.empty() ? state.get(slot.dof)
                                   : fraction_of(slot.segments, state.get(slot.dof));
    case Law::constant:
    case Law::by_hand:
      break;
  }
  return 0;
}

void Plan::encode(const rig::AllowedLevels& levels, std::span<ports::DmxFrame> frames) const {
  for (auto& frame : frames) frame.levels.fill(0);
  for (const Slot& slot : slots_) {
    const std::uint32_t raw =
        slot.law == Law::constant
            ? slot.constant
            : raw_of(drive(slot, levels.fixtures()[slot.fixture]), slot.bytes);
    auto& frame = frames[slot.universe];
    for (unsigned i = 0; i < slot.bytes; ++i)
      frame.levels[slot.first + i] =
          static_cast<std::uint8_t>(raw >> (8u * (slot.bytes - 1u - i)) & 0xffu);
  }
}

void Plan::read(const Slot& slot, double fraction, FixtureState& state) const {
  double value = fraction;
  if (!slot.segments.empty()) {
    const Segment* s = segment_at(slot.segments, fraction);
    if (s->law == Segment::Law::no_effect) return;
    const double width = s->dmx_to - s->dmx_from;
    const double x = width == 0 || s->law == Segment::Law::neutral
                         ? 0
                         : std::clamp((fraction - s->dmx_from) / width, 0.0, 1.0);
    value = s->physical_from + x * (s->physical_to - s->physical_from);
  }
  if (slot.law != Law::segments) value = light_of_drive(curves_[slot.curve], value);
  state.set(slot.dof, value);
}

void Plan::decode(std::span<const ports::DmxFrame> frames, std::span<FixtureState> fixtures) const {
  for (auto& state : fixtures) state = {};
  for (const Slot& slot : slots_) {
    if (slot.law == Law::constant || slot.law == Law::by_hand) continue;
    const std::uint32_t raw = raw_in(frames[slot.universe], slot.first, slot.bytes);
    read(slot, static_cast<double>(raw) / full_scale(slot.bytes), fixtures[slot.fixture]);
  }
  for (std::size_t i = 0; i < fixtures.size(); ++i) {
    if (no_dimmer_[i] == 0) continue;
    FixtureState& state = fixtures[i];
    double strongest = 0;
    for (const auto& entry : core::dofs())
      if (is_drive(entry.dof)) strongest = std::max(strongest, state.get(entry.dof));
    for (const auto& entry : core::dofs())
      if (is_drive(entry.dof) && state.has(entry.dof))
        state.set(entry.dof, strongest > 0 ? state.get(entry.dof) / strongest : 1);
    state.set(Dof::intensity, strongest);
  }
}

std::vector<Plan::Line> Plan::sheet() const {
  std::vector<Line> lines;
  for (const Slot& slot : slots_) {
    const std::string what = slot.law == Law::constant
                                 ? "constant " + std::to_string(slot.constant)
                                 : std::string(core::info(slot.dof).name) +
                                       (slot.law == Law::dimmed_drive ? " x level" : "") +
                                       (slot.law == Law::by_hand ? " (by hand)" : "");
    lines.push_back({slot.fixture, universes_[slot.universe], slot.first + 1,
                     slot.first + slot.bytes, slot.name,
                     what + ", " + std::to_string(8 * slot.bytes) + " bit"});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::pair(a.universe, a.first) < std::pair(b.universe, b.first);
  });
  return lines;
}

}  // namespace chiaro::patch
