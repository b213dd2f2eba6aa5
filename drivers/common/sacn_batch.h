// SPDX-License-Identifier: Apache-2.0
// The packets of one frame of all universes on their way together: one call to the system for
// dozens of them instead of one each.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "controller/ports/network.h"

namespace chiaro::drivers::sacn {

/// One per interface, shared by its ports; the loop's thread alone. Real-time.
class Batch {
 public:
  static constexpr const char* kKind = "sACN batch";
  /// Learns whether its packet left.
  class Sender {
   public:
    virtual ~Sender() = default;
    virtual void judge(bool sent) = 0;
  };

  /// All pointers stay good until the next `flush`. The first one's socket sends them all: sockets
  /// of one interface are alike. `sender` may be null.
  void add(ports::DatagramSocket& socket, const ports::Endpoint& to,
           std::span<const std::uint8_t> packet, Sender* sender) {
    if (count_ == kMost) flush();
    if (count_ == 0) socket_ = &socket;
    outgoing_[count_] = {&to, packet, false};
    senders_[count_++] = sender;
  }
  void flush() {
    if (count_ == 0) return;
    socket_->send_all(std::span(outgoing_).first(count_));
    for (std::size_t i = 0; i < count_; ++i)
      if (senders_[i] != nullptr) senders_[i]->judge(outgoing_[i].sent);
    count_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 256;
  std::array<ports::Outgoing, kMost> outgoing_;
  std::array<Sender*, kMost> senders_{};
  ports::DatagramSocket* socket_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace chiaro::drivers::sacn
