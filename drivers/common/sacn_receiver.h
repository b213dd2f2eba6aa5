// SPDX-License-Identifier: Apache-2.0
// What a good sACN node does with the packets it hears: the sequence rule per source, preview and
// other start codes kept out, highest priority wins, equal priorities merge highest-takes-
// precedence, sources end by saying so or by 2.5 s of silence. A state machine; time is an
// argument.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "controller/ports/clock.h"
#include "controller/ports/output.h"
#include "drivers/common/sacn_packet.h"

namespace chiaro::drivers::sacn {

/// E1.31 6.7.1, network data loss.
inline constexpr ports::Duration kSourceLoss = std::chrono::milliseconds(2500);

class Receiver {
 public:
  /// Listens for these universes; packets of others are ignored.
  explicit Receiver(std::vector<std::uint16_t> universes);

  enum class Heard { levels, terminated, refused, other_universe, out_of_sequence, not_for_lamps };
  /// Takes one datagram. `not_for_lamps`: a preview packet or a start code other than 0.
  Heard hear(std::span<const std::uint8_t> datagram, ports::TimePoint now);

  /// The merged levels of universe number i of the list, as of `now`. Without any live source the
  /// last levels stay ("hold last look"). Forgets sources that have gone silent.
  const ports::DmxFrame& frame(std::size_t i, ports::TimePoint now);
  std::size_t universes() const { return universes_.size(); }

  struct Source {
    Cid cid{};
    std::string name;
    std::uint8_t priority = 0, sequence = 0;
    ports::TimePoint heard;
    std::array<std::uint8_t, kSlots> levels{};
  };
  /// The live sources of universe number i.
  std::span<const Source> sources(std::size_t i) const { return universes_[i].sources; }

 private:
  struct Universe {
    ports::DmxFrame frame;
    std::vector<Source> sources;
  };
  static Heard hear(Universe& universe, const DataPacket& packet, ports::TimePoint now);
  static void merge(Universe& universe);

  std::vector<Universe> universes_;
};

}  // namespace chiaro::drivers::sacn
