// SPDX-License-Identifier: Apache-2.0
// A network in memory: what one socket sends, the others receive, in order and at once. Links can
// be unplugged. Sending allocates nothing, so that allocation guards may watch the sender.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "controller/ports/network.h"

namespace chiaro::support {

/// Thread-safe. Outlives its sockets' use, not necessarily the sockets themselves.
class FakeNetwork final : public ports::Network {
 public:
  FakeNetwork();
  ~FakeNetwork() override;

  core::Result<std::unique_ptr<ports::DatagramSocket>> open_datagram(
      const Options& options) override;
  /// 127.0.0.1 on every interface there is.
  std::optional<Address> address_of(const std::string& interface) override;

  /// While unplugged every send fails.
  void unplug(bool unplugged);
  /// Opening a socket on any other interface than these fails; "" and "lo" exist from the start.
  void add_interface(const std::string& name);
  /// Datagrams sent so far, delivered to somebody or not.
  std::uint64_t sent() const;
  /// Datagrams lost because a receiver did not fetch its own (each socket holds 4096).
  std::uint64_t dropped() const;

  struct Wire;

 private:
  std::shared_ptr<Wire> wire_;
};

}  // namespace chiaro::support
