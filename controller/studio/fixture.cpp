// SPDX-License-Identifier: Apache-2.0
// What a fixture can do as it is fitted, patched and mounted.
#include <algorithm>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/studio.h"

namespace chiaro::studio {

using core::Dof;

Optic Fixture::fitted_optic() const {
  Optic optic = profile.optic;
  if (modifiers.empty() || modifiers.front().width <= 0) return optic;
  optic.kind = Optic::Kind::rectangle;
  optic.width = modifiers.front().width;
  optic.height = modifiers.front().height;
  return optic;
}

core::Candela Fixture::fitted_output() const {
  const double loss = modifiers.empty() ? 0 : modifiers.front().loss_stops;
  return core::from_stops(-loss) * output;
}

namespace {

bool on_the_wire(const Fixture& fixture, Dof dof) {
  if (std::holds_alternative<VirtualMount>(fixture.mount)) return true;
  if (std::holds_alternative<NoPatch>(fixture.patch)) return false;
  if (fixture.mode >= fixture.profile.modes.size()) return false;
  const auto& channels = fixture.profile.modes[fixture.mode].channels;
  // Without a dimmer channel the drives carry the level.
  const auto carries = [&](const Channel& channel) {
    const bool drive = channel.dof && *channel.dof >= Dof::red && *channel.dof <= Dof::cyan;
    return channel.dof == dof || (dof == Dof::intensity && drive);
  };
  return std::any_of(channels.begin(), channels.end(), carries);
}

/// From the head's own angle to the mount's: straight, or the other way round.
void count_from_neutral(Channel& channel, double head_neutral, bool inverted) {
  const auto mounted = [&](double head) {
    return inverted ? head_neutral - head : head - head_neutral;
  };
  for (Segment& segment : channel.segments) {
    segment.physical_from = mounted(segment.physical_from);
    segment.physical_to = mounted(segment.physical_to);
  }
}

void mount_axis(const PanTiltMount& head, Channel& channel) {
  const bool pans = (*channel.dof == Dof::pan) != head.swap;
  channel.dof = pans ? Dof::pan : Dof::tilt;
  if (channel.use == ChannelUse::trims) {
    count_from_neutral(channel, 0, pans ? head.invert_pan : head.invert_tilt);
  } else {
    count_from_neutral(channel, pans ? head.head_pan : head.head_tilt,
                       pans ? head.invert_pan : head.invert_tilt);
  }
}

struct Motor {
  AxisWire wire;
  Dof dof = Dof::arc;
  core::Range range;
};
std::optional<Motor> motor_of(const Mount& mount) {
  std::optional<Motor> motor;
  if (const auto* arc = std::get_if<ArcMount>(&mount)) motor = {arc->axis, Dof::arc, arc->angle};
  if (const auto* track = std::get_if<TrackMount>(&mount))
    motor = {track->axis, Dof::track, {0, 1}};
  return motor && motor->wire.slot > 0 ? motor : std::nullopt;
}

Channel channel_of(const Motor& motor) {
  Channel channel;
  channel.name = core::info(motor.dof).name;
  channel.dof = motor.dof;
  channel.bytes = motor.wire.bytes;
  channel.offset = motor.wire.universe == 0 ? motor.wire.slot - 1 : 0;
  channel.segments = {{0, 1, motor.range.least, motor.range.most, Segment::Law::continuous}};
  return channel;
}

/// A motor on the lamp's own patch.
std::optional<Channel> near_motor(const Mount& mount) {
  const auto motor = motor_of(mount);
  return motor && motor->wire.universe == 0 ? std::optional(channel_of(*motor)) : std::nullopt;
}

/// What the head can reach of the mount's range; nothing when no channel moves it.
std::optional<core::Range> head_range(const Fixture& fixture, Dof dof, core::Range mounted) {
  if (std::holds_alternative<NoPatch>(fixture.patch)) return std::nullopt;
  for (const Channel& channel : fixture.wired_channels()) {
    if (channel.dof != dof || channel.use != ChannelUse::controls) continue;
    core::Range reach{1e9, -1e9};
    for (const Segment& s : channel.segments) {
      if (s.law != Segment::Law::continuous) continue;
      reach.least = std::min({reach.least, s.physical_from, s.physical_to});
      reach.most = std::max({reach.most, s.physical_from, s.physical_to});
    }
    const core::Range both{std::max(reach.least, mounted.least),
                           std::min(reach.most, mounted.most)};
    return both.least <= both.most ? both : reach;
  }
  return std::nullopt;
}

std::optional<core::Range> light_range(const Fixture& fixture, Dof dof) {
  const auto own = profiles::own_range(fixture.profile, dof);
  for (const HandBinding& binding : fixture.by_hand)
    if (binding.dof == dof) return binding.range ? binding.range : own;
  return on_the_wire(fixture, dof) ? own : std::nullopt;
}

}  // namespace

std::vector<std::pair<Dof, core::Range>> Fixture::ranges() const {
  std::vector<std::pair<Dof, core::Range>> all;
  if (!controlled) return all;
  for (const core::DofInfo& each : core::dofs())
    if (!core::is_placement(each.dof) || each.dof == Dof::zoom)
      if (auto range = light_range(*this, each.dof)) {
        if (each.dof == Dof::intensity) range->most = std::min(range->most, limits.most);
        all.emplace_back(each.dof, *range);
      }
  const auto move_within = [&](const Region& region) {
    all.emplace_back(Dof::azimuth, region.azimuth);
    all.emplace_back(Dof::elevation, region.elevation);
    all.emplace_back(Dof::distance, region.distance);
  };
  if (const auto* stand = std::get_if<StandMount>(&mount)) move_within(stand->region);
  if (const auto* free = std::get_if<VirtualMount>(&mount)) move_within(free->region);
  if (const auto* head = std::get_if<PanTiltMount>(&mount)) {
    if (const auto pan = head_range(*this, Dof::pan, head->pan)) all.emplace_back(Dof::pan, *pan);
    if (const auto tilt = head_range(*this, Dof::tilt, head->tilt))
      all.emplace_back(Dof::tilt, *tilt);
  }
  if (const auto* arc = std::get_if<ArcMount>(&mount)) all.emplace_back(Dof::arc, arc->angle);
  if (std::holds_alternative<TrackMount>(mount)) all.emplace_back(Dof::track, core::Range{0, 1});
  return all;
}

std::vector<Channel> Fixture::wired_channels() const {
  std::vector<Channel> channels;
  if (mode < profile.modes.size()) channels = profile.modes[mode].channels;
  if (const auto* head = std::get_if<PanTiltMount>(&mount))
    for (Channel& channel : channels)
      if (channel.dof == Dof::pan || channel.dof == Dof::tilt) mount_axis(*head, channel);
  if (auto channel = near_motor(mount)) channels.push_back(std::move(*channel));
  return channels;
}

std::optional<Fixture::FarMotor> Fixture::far_motor() const {
  const auto motor = motor_of(mount);
  if (!motor || motor->wire.universe == 0) return std::nullopt;
  return FarMotor{channel_of(*motor),
                  {motor->wire.universe, static_cast<std::uint16_t>(motor->wire.slot)}};
}

int Fixture::footprint() const {
  int slots = mode < profile.modes.size() ? std::max(1, profile.modes[mode].footprint) : 1;
  if (const auto channel = near_motor(mount))
    slots = std::max(slots, channel->offset + channel->bytes);
  return slots;
}

}  // namespace chiaro::studio
