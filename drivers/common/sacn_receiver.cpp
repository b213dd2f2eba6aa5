// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/sacn_receiver.h"

#include <algorithm>

namespace chiaro::drivers::sacn {

Receiver::Receiver(std::vector<std::uint16_t> universes) {
  for (const std::uint16_t number : universes) {
    universes_.emplace_back();
    universes_.back().frame.universe = number;
  }
}

Receiver::Heard Receiver::hear(std::span<const std::uint8_t> datagram, ports::TimePoint now) {
  const auto packet = parse(datagram);
  if (!packet) return Heard::refused;
  for (Universe& universe : universes_)
    if (universe.frame.universe == packet->universe) return hear(universe, *packet, now);
  return Heard::other_universe;
}

Receiver::Heard Receiver::hear(Universe& universe, const DataPacket& packet, ports::TimePoint now) {
  auto& sources = universe.sources;
  auto source = std::find_if(sources.begin(), sources.end(),
                             [&](const Source& s) { return s.cid == packet.cid; });
  if (source != sources.end()) {
    if (now - source->heard <= kSourceLoss && !in_sequence(source->sequence, packet.sequence))
      return Heard::out_of_sequence;
    source->sequence = packet.sequence;
  }
  if (packet.terminated) {
    if (source != sources.end()) sources.erase(source);
    merge(universe);
    return Heard::terminated;
  }
  if (packet.preview || packet.start_code != 0) return Heard::not_for_lamps;
  if (source == sources.end()) {
    sources.emplace_back();
    source = std::prev(sources.end());
    source->cid = packet.cid;
    source->sequence = packet.sequence;
  }
  source->name = packet.source_name;
  source->priority = packet.priority;
  source->heard = now;
  source->levels.fill(0);
  std::copy(packet.levels.begin(), packet.levels.end(), source->levels.begin());
  merge(universe);
  return Heard::levels;
}

void Receiver::merge(Universe& universe) {
  if (universe.sources.empty()) return;
  std::uint8_t highest = 0;
  for (const Source& source : universe.sources) highest = std::max(highest, source.priority);
  universe.frame.levels.fill(0);
  for (const Source& source : universe.sources)
    if (source.priority == highest)
      for (std::size_t i = 0; i < kSlots; ++i)
        universe.frame.levels[i] = std::max(universe.frame.levels[i], source.levels[i]);
}

const ports::DmxFrame& Receiver::frame(std::size_t i, ports::TimePoint now) {
  Universe& universe = universes_[i];
  const auto gone =
      std::erase_if(universe.sources, [&](const Source& s) { return now - s.heard > kSourceLoss; });
  if (gone > 0) merge(universe);
  return universe.frame;
}

}  // namespace chiaro::drivers::sacn
