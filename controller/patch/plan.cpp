// SPDX-License-Identifier: Apache-2.0
#include "controller/patch/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "controller/patch/curve.h"

namespace chiaro::patch {
namespace {

using core::Dof;
using core::FixtureState;
using studio::Segment;

bool is_drive(Dof dof) {
  return core::is_colour(dof) && dof != Dof::cct && dof != Dof::tint && dof != Dof::crossfade;
}

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

/// Of the raw values about `wanted`, the one that a trim completes best; the least trim among
/// equals. Both channels are rounded once.
std::pair<std::uint32_t, std::uint32_t> coarse_and_trim(double wanted,
                                                        const std::vector<Segment>& coarse,
                                                        int coarse_bytes,
                                                        const std::vector<Segment>& trim,
                                                        int trim_bytes) {
  const std::uint32_t most = full_scale(coarse_bytes);
  const std::uint32_t near = raw_of(fraction_of(coarse, wanted), coarse_bytes);
  std::pair<std::uint32_t, std::uint32_t> best{near, 0};
  double least = std::numeric_limits<double>::infinity(), least_trim = least;
  for (std::uint32_t raw = near > 0 ? near - 1 : 0; raw <= std::min(near + 1, most); ++raw) {
    const auto base = meaning_of(coarse, static_cast<double>(raw) / most);
    if (!base) continue;
    const std::uint32_t fine = raw_of(fraction_of(trim, wanted - *base), trim_bytes);
    const double added =
        meaning_of(trim, static_cast<double>(fine) / full_scale(trim_bytes)).value_or(0);
    const double gap = std::abs(*base + added - wanted);
    if (gap > least + 1e-9 || (gap > least - 1e-9 && std::abs(added) >= least_trim)) continue;
    best = {raw, fine};
    least = gap;
    least_trim = std::abs(added);
  }
  return best;
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
  for (const auto& fixture : studio.fixtures)
    if (const auto motor = fixture.far_motor()) plan.universes_.push_back(motor->patch.universe);
  std::sort(plan.universes_.begin(), plan.universes_.end());
  plan.universes_.erase(std::unique(plan.universes_.begin(), plan.universes_.end()),
                        plan.universes_.end());
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const auto& fixture = studio.fixtures[i];
    plan.curves_.push_back(fixture.curve);
    if (std::holds_alternative<studio::DmxPatch>(fixture.patch)) plan.add(fixture, i);
    plan.add_far_motor(fixture, i);
    if (const auto* modbus = std::get_if<studio::ModbusPatch>(&fixture.patch);
        modbus != nullptr && warnings != nullptr)
      warnings->push_back({fixture.place,
                           "fixture '" + fixture.name + "' is patched to Modbus bus '" +
                               modbus->bus + "' directly, which sends nothing",
                           "give the device a universe of its own, {universe 9: {modbus: {bus: " +
                               modbus->bus + ", unit: 1, map: …}}}, and patch it there",
                           true});
  }
  return plan;
}

void Plan::add(const studio::Fixture& fixture, std::size_t index) {
  const auto& mode = fixture.profile.modes.at(fixture.mode);
  const bool no_dimmer =
      !has_channel(mode, Dof::intensity) &&
      std::any_of(mode.channels.begin(), mode.channels.end(),
                  [](const studio::Channel& c) { return c.dof && is_drive(*c.dof); });
  no_dimmer_[index] = no_dimmer ? 1 : 0;
  const std::size_t from = slots_.size();
  for (const auto& channel : fixture.wired_channels()) {
    Slot slot =
        slot_of(fixture, index, channel, std::get<studio::DmxPatch>(fixture.patch), no_dimmer);
    if (*std::max_element(slot.at.begin(), slot.at.begin() + slot.bytes) < ports::kSlots)
      slots_.push_back(std::move(slot));
  }
  join_trims(from);
}

void Plan::add_far_motor(const studio::Fixture& fixture, std::size_t index) {
  const auto motor = fixture.far_motor();
  if (motor && motor->patch.address + motor->channel.bytes - 1 <= static_cast<int>(ports::kSlots))
    slots_.push_back(slot_of(fixture, index, motor->channel, motor->patch, false));
}

Plan::Slot Plan::slot_of(const studio::Fixture& fixture, std::size_t index,
                         const studio::Channel& channel, const studio::DmxPatch& patch,
                         bool no_dimmer) const {
  Slot slot;
  slot.fixture = static_cast<std::uint32_t>(index);
  slot.universe = static_cast<std::uint32_t>(
      std::lower_bound(universes_.begin(), universes_.end(), patch.universe) - universes_.begin());
  slot.bytes = static_cast<std::uint8_t>(channel.bytes);
  for (int byte = 0; byte < channel.bytes; ++byte)
    slot.at[static_cast<std::size_t>(byte)] =
        static_cast<std::uint16_t>(patch.address - 1 + channel.slot(byte));
  slot.name = channel.name;
  slot.use = channel.use;
  slot.curve = static_cast<std::uint32_t>(index);
  slot.segments = channel.segments;
  if (!channel.dof) {
    slot.constant = raw_of(channel.constant, channel.bytes);
    return slot;
  }
  slot.constant = raw_of(channel.rest.value_or(0), channel.bytes);
  slot.dof = *channel.dof;
  slot.law = set_by_hand(fixture, slot.dof)    ? Law::by_hand
             : slot.dof == Dof::intensity      ? Law::level
             : no_dimmer && is_drive(slot.dof) ? Law::dimmed_drive
                                               : Law::segments;
  return slot;
}

/// Tells each controlling slot of this fixture which slot trims it.
void Plan::join_trims(std::size_t from) {
  for (std::size_t i = from; i < slots_.size(); ++i) {
    if (slots_[i].law == Law::constant || slots_[i].use != studio::ChannelUse::trims) continue;
    for (std::size_t k = from; k < slots_.size(); ++k)
      if (slots_[k].law != Law::constant && slots_[k].dof == slots_[i].dof &&
          slots_[k].use == studio::ChannelUse::controls)
        slots_[k].trim = static_cast<std::int32_t>(i);
  }
}

std::vector<ports::DmxFrame> Plan::blank_frames() const {
  std::vector<ports::DmxFrame> frames(universes_.size());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].universe = universes_[i];
  return frames;
}

namespace {

/// The bytes of one channel in its frame.
template <class Slot>
void write(const Slot& slot, std::uint32_t raw, ports::DmxFrame& frame) {
  for (unsigned i = 0; i < slot.bytes; ++i)
    frame.levels[slot.at[i]] =
        static_cast<std::uint8_t>(raw >> (8u * (slot.bytes - 1u - i)) & 0xffu);
}
template <class Slot>
double read_fraction(const Slot& slot, const ports::DmxFrame& frame) {
  std::uint32_t raw = 0;
  for (unsigned i = 0; i < slot.bytes; ++i) raw = raw << 8u | frame.levels[slot.at[i]];
  return static_cast<double>(raw) / full_scale(slot.bytes);
}

}  // namespace

/// What the channel must mean: a drive for light, else the DOF's own value.
double Plan::meaning(const Slot& slot, const FixtureState& state) const {
  if (slot.law == Law::level) return drive_of_light(curves_[slot.curve], state.get(Dof::intensity));
  if (slot.law == Law::dimmed_drive)
    return drive_of_light(curves_[slot.curve], state.get(slot.dof) * state.get(Dof::intensity));
  return state.get(slot.dof);
}

void Plan::put(const Slot& slot, const FixtureState& state, ports::DmxFrame& frame) const {
  if (slot.law == Law::constant) return write(slot, slot.constant, frame);
  if (slot.use == studio::ChannelUse::trims) return;  // written with what it trims
  if (slot.law == Law::by_hand) return;
  if (slot.law == Law::segments && !state.has(slot.dof)) return write(slot, slot.constant, frame);
  const double wanted = meaning(slot, state);
  if (slot.trim < 0)
    return write(slot, raw_of(fraction_of(slot.segments, wanted), slot.bytes), frame);
  const Slot& trim = slots_[static_cast<std::size_t>(slot.trim)];
  const auto [coarse, fine] =
      coarse_and_trim(wanted, slot.segments, slot.bytes, trim.segments, trim.bytes);
  write(slot, coarse, frame);
  write(trim, fine, frame);
}

void Plan::encode(const rig::AllowedLevels& levels, std::span<ports::DmxFrame> frames) const {
  for (auto& frame : frames) frame.levels.fill(0);
  for (const Slot& slot : slots_) put(slot, levels.fixtures()[slot.fixture], frames[slot.universe]);
}

void Plan::read(const Slot& slot, const ports::DmxFrame& frame, FixtureState& state) const {
  auto value = meaning_of(slot.segments, read_fraction(slot, frame));
  if (!value) return;
  if (slot.trim >= 0) {
    const Slot& trim = slots_[static_cast<std::size_t>(slot.trim)];
    *value += meaning_of(trim.segments, read_fraction(trim, frame)).value_or(0);
  }
  if (slot.law != Law::segments) *value = light_of_drive(curves_[slot.curve], *value);
  state.set(slot.dof, *value);
}

void Plan::decode(std::span<const ports::DmxFrame> frames, std::span<FixtureState> fixtures) const {
  for (auto& state : fixtures) state = {};
  for (const Slot& slot : slots_)
    if (slot.law != Law::constant && slot.law != Law::by_hand &&
        slot.use == studio::ChannelUse::controls)
      read(slot, frames[slot.universe], fixtures[slot.fixture]);
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
    const std::string law = law_in_words(slot) + ", " + std::to_string(8 * slot.bytes) + " bit";
    // Bytes that stand apart are lines of their own.
    unsigned from = 0;
    for (unsigned i = 1; i <= slot.bytes; ++i) {
      if (i < slot.bytes && slot.at[i] == slot.at[i - 1] + 1) continue;
      lines.push_back({slot.fixture, universes_[slot.universe], slot.at[from] + 1,
                       slot.at[i - 1] + 1, slot.name + (from > 0 ? " fine" : ""), law});
      from = i;
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::pair(a.universe, a.first) < std::pair(b.universe, b.first);
  });
  return lines;
}

std::string Plan::law_in_words(const Slot& slot) {
  if (slot.law == Law::constant) {
    const char* held = slot.use == studio::ChannelUse::open  ? "open "
                       : slot.use == studio::ChannelUse::pwm ? "frequency "
                                                             : "constant ";
    return held + std::to_string(slot.constant);
  }
  std::string words(core::info(slot.dof).name);
  if (slot.law == Law::dimmed_drive) words += " x level";
  if (slot.law == Law::by_hand) words += " (by hand)";
  if (slot.use == studio::ChannelUse::trims) words += ", added to the coarse one";
  return words;
}

}  // namespace chiaro::patch
