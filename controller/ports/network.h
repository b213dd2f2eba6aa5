// SPDX-License-Identifier: Apache-2.0
// Datagrams as drivers need them. The real ones are in drivers/common; tests use an in-memory
// network on one fake clock.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::ports {

struct Endpoint {
  std::string address;  ///< dotted IPv4
  std::uint16_t port = 0;
  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// A datagram on its way; what it points to is the sender's.
struct Outgoing {
  const Endpoint* to = nullptr;
  std::span<const std::uint8_t> datagram;
  bool sent = false;
};

/// One UDP socket. One thread at a time.
class DatagramSocket {
 public:
  virtual ~DatagramSocket() = default;
  /// Never blocks; false when the datagram could not be sent (link down, buffer full). Real-time:
  /// no allocation, lock or throw.
  virtual bool send(const Endpoint& to, std::span<const std::uint8_t> datagram) = 0;
  /// The same for many at once, in their order: cheaper where the system takes them together. Says
  /// of each whether it was sent.
  virtual void send_all(std::span<Outgoing> datagrams) {
    for (Outgoing& each : datagrams) each.sent = send(*each.to, each.datagram);
  }
  /// Never blocks; nothing when no datagram waits. Returns the number of bytes written to `into`
  /// (a longer datagram is cut).
  virtual std::optional<std::size_t> receive(std::span<std::uint8_t> into, Endpoint* from) = 0;
  /// Joins a multicast group on the socket's interface.
  virtual core::Result<core::Done> join(const std::string& group) = 0;
  /// For poll(2); -1 when there is none (in memory).
  virtual int descriptor() const { return -1; }
};

/// Thread-safe.
class Network {
 public:
  virtual ~Network() = default;
  struct Options {
    std::string interface;         ///< name such as "lo" or "eth0"; empty = the system's choice
    std::uint16_t local_port = 0;  ///< 0 = any free port (a sender)
    bool share_port = false;       ///< several receivers on one port (multicast)
    bool broadcast = false;        ///< may send to the broadcast address
  };
  virtual core::Result<std::unique_ptr<DatagramSocket>> open_datagram(const Options& options) = 0;
  /// Who we are on that interface; "" = the one the system would choose. Nothing when it is down.
  struct Address {
    std::string own, broadcast;  ///< dotted IPv4
    std::array<std::uint8_t, 6> mac{};
  };
  virtual std::optional<Address> address_of(const std::string& interface) = 0;
};

}  // namespace chiaro::ports
