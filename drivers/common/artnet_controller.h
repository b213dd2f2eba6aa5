// SPDX-License-Identifier: Apache-2.0
// Who wants which port-address: a controller asks every three seconds, nodes answer, and levels go
// to those alone. One per interface, shared by its ports, because answers come to one UDP port.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "controller/ports/clock.h"
#include "controller/ports/network.h"
#include "drivers/common/artnet_packet.h"

namespace chiaro::drivers::artnet {

/// Thread-bound: the one thread that sends on its ports. `hear` and `subscribers` are real-time.
class Controller {
 public:
  static constexpr const char* kKind = "Art-Net controller";
  static constexpr ports::Duration kPollPeriod = std::chrono::milliseconds(2750);
  /// Three polls unanswered, and the answer's own three seconds.
  static constexpr ports::Duration kGone = 3 * kPollPeriod + std::chrono::seconds(3);
  /// More than so many listeners to one port-address are told by one broadcast.
  static constexpr std::size_t kMostUnicast = 40;

  Controller(ports::Network& network, std::string interface);

  /// Opens the socket if it is not open.
  core::Result<core::Done> open();
  /// No more datagrams are read at once: on a network full of others' levels the output loop must
  /// go on. What is left over is read with the next frame.
  static constexpr int kMostAtOnce = 64;

  /// Polls when it is time, and takes the answers that have come; once for each `now`. Real-time.
  void hear(ports::TimePoint now);
  bool send(const ports::Endpoint& to, std::span<const std::uint8_t> datagram);
  const ports::Endpoint& everybody() const { return everybody_; }

  /// Who listens to it now. Beyond kMostUnicast there is one entry: everybody.
  std::span<const ports::Endpoint> subscribers(int port_address, ports::TimePoint now);
  std::size_t nodes() const { return known_; }

 private:
  struct Node {
    HeardReply reply;
    ports::Endpoint at;
    ports::TimePoint heard;
  };
  void take(const HeardReply& reply, const ports::Endpoint& from, ports::TimePoint now);

  ports::Network& network_;
  const std::string interface_;
  ports::Endpoint everybody_{"255.255.255.255", kPort};
  std::string own_;
  std::unique_ptr<ports::DatagramSocket> socket_;
  ports::TimePoint next_poll_, heard_;
  std::array<Node, 512> nodes_;
  std::size_t known_ = 0;
  std::array<ports::Endpoint, kMostUnicast + 1> found_;
};

}  // namespace chiaro::drivers::artnet
