// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/sacn_receiver.h"

#include <algorithm>

namespace chiaro::drivers::sacn {

Receiver::Receiver(std::vector<std::uint16_t> universes)
    : Receiver(std::move(universes), Options{}) {}

Receiver::Receiver(std::vector<std::uint16_t> universes, const Options& options)
    : options_(options) {
  for (const std::uint16_t number : universes) {
    universes_.emplace_back();
    universes_.back().frame.universe = number;
  }
}

Receiver::Heard Receiver::hear(std::span<const std::uint8_t> datagram, ports::TimePoint now) {
  const auto packet = parse(datagram);
  if (!packet) {
    const auto sync = parse_sync(datagram);
    return sync ? hear_sync(*sync, now) : Heard::refused;
  }
  for (Universe& universe : universes_)
    if (universe.frame.universe == packet->universe) return hear(universe, *packet, now);
  return Heard::other_universe;
}

Receiver::Heard Receiver::hear(Universe& universe, const DataPacket& packet, ports::TimePoint now) {
  auto& sources = universe.sources;
  auto source = std::find_if(sources.begin(), sources.end(),
                             [&](const Source& s) { return s.cid == packet.cid; });
  const bool known = source != sources.end();
  if (known) {
    if (now - source->heard <= kSourceLoss && !in_sequence(source->sequence, packet.sequence))
      return Heard::out_of_sequence;
    source->sequence = packet.sequence;
  }
  if (packet.terminated) {
    if (known) sources.erase(source);
    forget_syncs();
    merge(universe);
    return Heard::terminated;
  }
  const bool priorities = options_.per_address_priority && packet.start_code == kAddressPriorities;
  if (packet.preview || (packet.start_code != kLevels && !priorities)) return Heard::not_for_lamps;
  if (!known) {
    if (sources.size() >= kMostSources) return Heard::refused;
    if (priorities) return Heard::priorities;  // levels make a source; the next 0xDD is soon here
    sources.emplace_back();
    source = std::prev(sources.end());
    source->cid = packet.cid;
    source->sequence = packet.sequence;
    source->since = now;
    source->counts = !options_.per_address_priority;
  }
  if (priorities) {
    source->priorities.fill(0);
    std::copy(packet.levels.begin(), packet.levels.end(), source->priorities.begin());
    source->priorities_heard = now;
    source->counts = true;
  } else {
    source->name = packet.source_name;
    source->priority = packet.priority;
    source->heard = now;
    source->counts = source->counts || now - source->since >= kPriorityWait;
    take_levels(*source, packet, now);
  }
  merge(universe);
  return priorities ? Heard::priorities : Heard::levels;
}

void Receiver::take_levels(Source& source, const DataPacket& packet, ports::TimePoint now) {
  source.waits_for_sync = must_wait(packet, now);
  source.sync_universe = packet.sync_universe;
  Slots& into = source.waits_for_sync ? source.pending : source.levels;
  into.fill(0);
  std::copy(packet.levels.begin(), packet.levels.end(), into.begin());
}

/// E1.31 11.1: until a first synchronisation packet has come, and when they have ceased, levels
/// count at once - unless Force_Synchronization says to hold when they have ceased.
bool Receiver::must_wait(const DataPacket& packet, ports::TimePoint now) {
  if (!options_.synchronised || packet.sync_universe == 0) return false;
  auto sync = std::find_if(syncs_.begin(), syncs_.end(), [&](const Sync& s) {
    return s.universe == packet.sync_universe && s.cid == packet.cid;
  });
  if (sync == syncs_.end()) {
    if (syncs_.size() < kMostSyncs)
      syncs_.push_back({packet.sync_universe, packet.cid, 0, std::nullopt});
    return false;
  }
  if (!sync->heard) return false;
  return now - *sync->heard <= kSourceLoss || packet.force_sync;
}

Receiver::Heard Receiver::hear_sync(const HeardSync& packet, ports::TimePoint now) {
  const auto sync = std::find_if(syncs_.begin(), syncs_.end(), [&](const Sync& s) {
    return s.universe == packet.universe && s.cid == packet.cid;
  });
  if (sync == syncs_.end()) return Heard::other_universe;
  if (sync->heard && now - *sync->heard <= kSourceLoss &&
      !in_sequence(sync->sequence, packet.sequence))
    return Heard::out_of_sequence;
  sync->sequence = packet.sequence;
  sync->heard = now;
  for (Universe& universe : universes_) {
    for (Source& source : universe.sources) {
      if (!source.waits_for_sync || source.cid != packet.cid ||
          source.sync_universe != packet.universe)
        continue;
      source.levels = source.pending;
      source.waits_for_sync = false;
    }
    merge(universe);
  }
  return Heard::sync;
}

std::uint16_t Receiver::sync_to_join() {
  if (joined_.size() >= kMostJoined) return 0;  // the system allows about twenty groups a socket
  for (const Sync& sync : syncs_)
    if (std::find(joined_.begin(), joined_.end(), sync.universe) == joined_.end())
      return joined_.emplace_back(sync.universe);
  return 0;
}

/// Those that no source names any more.
void Receiver::forget_syncs() {
  std::erase_if(syncs_, [&](const Sync& sync) {
    for (const Universe& universe : universes_)
      for (const Source& source : universe.sources)
        if (source.cid == sync.cid && source.sync_universe == sync.universe) return false;
    return true;
  });
}

std::optional<int> Receiver::priority_at(const Source& source, std::size_t i) const {
  if (!source.counts) return std::nullopt;
  if (!source.priorities_heard) return source.priority;  // 0 is a priority like any other
  const int own = source.priorities[i];
  return own == 0 || own > kMostPriority ? std::nullopt : std::optional<int>(own);
}

void Receiver::merge(Universe& universe) const {
  const bool any = std::any_of(universe.sources.begin(), universe.sources.end(),
                               [](const Source& source) { return source.counts; });
  if (!any) return;
  for (std::size_t i = 0; i < kSlots; ++i) {
    int highest = -1;
    std::uint8_t level = 0;
    for (const Source& source : universe.sources) {
      const auto priority = priority_at(source, i);
      if (!priority || *priority < highest) continue;
      level = *priority > highest ? source.levels[i] : std::max(level, source.levels[i]);
      highest = *priority;
    }
    universe.frame.levels[i] = level;
  }
}

const ports::DmxFrame& Receiver::frame(std::size_t i, ports::TimePoint now) {
  Universe& universe = universes_[i];
  bool changed = std::erase_if(universe.sources,
                               [&](const Source& s) { return now - s.heard > kSourceLoss; }) > 0;
  for (Source& source : universe.sources) {
    if (!source.counts && now - source.since >= kPriorityWait) {
      source.counts = true;
      changed = true;
    }
    if (source.priorities_heard && now - *source.priorities_heard > kSourceLoss) {
      source.priorities_heard.reset();
      changed = true;
    }
  }
  if (changed) {
    forget_syncs();
    merge(universe);
  }
  return universe.frame;
}

}  // namespace chiaro::drivers::sacn
