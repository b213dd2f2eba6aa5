// SPDX-License-Identifier: Apache-2.0
// What a good sACN node does with the packets it hears: the sequence rule per source, preview and
// other start codes kept out, highest priority wins (for each address where a source says so),
// equal priorities merge highest-takes-precedence, synchronised levels wait for their packet,
// sources end by saying so or by 2.5 s of silence. A state machine; time is an argument.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "controller/ports/clock.h"
#include "controller/ports/output.h"
#include "drivers/common/sacn_packet.h"

namespace chiaro::drivers::sacn {

/// E1.31 6.7.1, network data loss; the same silence ends a synchronisation (11.1.2) and a source's
/// priorities per address.
inline constexpr ports::Duration kSourceLoss = std::chrono::milliseconds(2500);
/// So long a new source's levels wait for its priorities, lest lamps jump when they arrive.
inline constexpr ports::Duration kPriorityWait = std::chrono::milliseconds(1500);

/// Bounded in memory, whatever others send: so many sources a universe are heard (later ones are
/// refused), so many of their synchronisations kept, so many of those universes joined.
class Receiver {
 public:
  static constexpr std::size_t kMostSources = 16, kMostSyncs = 32, kMostJoined = 12;
  struct Options {
    /// Heeds start code 0xDD. Then a new source counts from its first 0xDD packet, or 1.5 s after
    /// its first levels.
    bool per_address_priority = false;
    /// Levels with a synchronisation universe wait for its packet.
    bool synchronised = false;
  };
  /// Listens for these universes; packets of others are ignored.
  explicit Receiver(std::vector<std::uint16_t> universes);
  Receiver(std::vector<std::uint16_t> universes, const Options& options);

  enum class Heard {
    levels,
    priorities,
    sync,
    terminated,
    refused,
    other_universe,
    out_of_sequence,
    not_for_lamps  ///< a preview packet or a start code that means no levels
  };
  /// Takes one datagram.
  Heard hear(std::span<const std::uint8_t> datagram, ports::TimePoint now);

  /// The merged levels of universe number i of the list, as of `now`. Without any live source the
  /// last levels stay ("hold last look"). Forgets sources that have gone silent.
  const ports::DmxFrame& frame(std::size_t i, ports::TimePoint now);
  std::size_t universes() const { return universes_.size(); }

  /// A synchronisation universe that was named since the last call and not heard of before; 0 =
  /// none. Whoever owns the socket joins its group.
  std::uint16_t sync_to_join();

  using Slots = std::array<std::uint8_t, kSlots>;
  struct Source {
    Cid cid{};
    std::string name;
    std::uint8_t priority = 0, sequence = 0;
    ports::TimePoint heard;
    Slots levels{};

    ports::TimePoint since;  ///< its first levels
    bool counts = true;      ///< false while its priorities are awaited
    std::optional<ports::TimePoint> priorities_heard;
    Slots priorities{};
    bool waits_for_sync = false;
    std::uint16_t sync_universe = 0;
    Slots pending{};
  };
  /// The live sources of universe number i.
  std::span<const Source> sources(std::size_t i) const { return universes_[i].sources; }

 private:
  struct Universe {
    ports::DmxFrame frame;
    std::vector<Source> sources;
  };
  struct Sync {
    std::uint16_t universe = 0;
    Cid cid{};
    std::uint8_t sequence = 0;
    std::optional<ports::TimePoint> heard;
  };
  Heard hear(Universe& universe, const DataPacket& packet, ports::TimePoint now);
  Heard hear_sync(const HeardSync& packet, ports::TimePoint now);
  void take_levels(Source& source, const DataPacket& packet, ports::TimePoint now);
  bool must_wait(const DataPacket& packet, ports::TimePoint now);
  void merge(Universe& universe) const;
  void forget_syncs();
  /// Priority of the source at slot i; nothing when it does not drive that slot.
  std::optional<int> priority_at(const Source& source, std::size_t i) const;

  const Options options_;
  std::vector<Universe> universes_;
  std::vector<Sync> syncs_;            ///< each with a source that names it
  std::vector<std::uint16_t> joined_;  ///< synchronisation universes, told by `sync_to_join`
};

}  // namespace chiaro::drivers::sacn
