// SPDX-License-Identifier: Apache-2.0
// What a good Art-Net node does: answers polls, numbers heeded, two senders merged highest-takes-
// precedence until one has been silent for ten seconds, levels held back for ArtSync once one has
// come. A state machine; time is an argument.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "controller/ports/network.h"
#include "controller/ports/output.h"
#include "drivers/common/artnet_packet.h"

namespace chiaro::drivers::artnet {

inline constexpr ports::Duration kMergeTimeout = std::chrono::seconds(10);
/// Without an ArtSync for so long a node shows levels at once again.
inline constexpr ports::Duration kSyncTimeout = std::chrono::seconds(4);
/// A node answers a poll after a random while of up to this, so that not all speak at once.
inline constexpr ports::Duration kReplyWithin = std::chrono::seconds(1);

class Node {
 public:
  struct Identity {
    std::array<std::uint8_t, 4> ip{};
    std::array<std::uint8_t, 6> mac{};
    std::string name;
  };
  /// Port-addresses by their index; universe numbers are the caller's.
  Node(std::vector<int> port_addresses, Identity identity);

  enum class Heard { levels, sync, poll, other_port, out_of_sequence, third_source, other };
  Heard hear(std::span<const std::uint8_t> datagram, const ports::Endpoint& from,
             ports::TimePoint now);

  /// Answers that are due now, each to be sent to `to`.
  struct Answer {
    ports::Endpoint to;
    std::vector<std::uint8_t> bytes;
  };
  std::vector<Answer> answers(ports::TimePoint now);

  const std::array<std::uint8_t, kSlots>& levels(std::size_t i, ports::TimePoint now);
  /// The addresses of the live senders of port-address number i.
  std::vector<std::string> sources(std::size_t i) const;
  std::size_t ports() const { return inputs_.size(); }

 private:
  struct Source {
    std::string address;
    std::uint8_t sequence = 0;
    ports::TimePoint heard;
    std::array<std::uint8_t, kSlots> levels{};
  };
  struct Input {
    int port_address = 0;
    std::vector<Source> sources;  ///< at most 2
    std::array<std::uint8_t, kSlots> merged{}, shown{};
  };
  Heard take(Input& input, const HeardDmx& packet, const ports::Endpoint& from,
             ports::TimePoint now);
  void show(Input& input, ports::TimePoint now) const;
  bool synchronised(ports::TimePoint now) const;

  const Identity identity_;
  std::vector<Input> inputs_;
  std::optional<ports::TimePoint> synced_;
  std::optional<ports::TimePoint> answer_at_;
  std::vector<ports::Endpoint> asked_by_;
  std::uint32_t dice_;
};

}  // namespace chiaro::drivers::artnet
