// SPDX-License-Identifier: Apache-2.0
// Real UDP sockets behind ports::Network.
#pragma once

#include "controller/ports/network.h"

namespace chiaro::drivers {

class SystemNetwork final : public ports::Network {
 public:
  core::Result<std::unique_ptr<ports::DatagramSocket>> open_datagram(
      const Options& options) override;
  std::optional<Address> address_of(const std::string& interface) override;
};

}  // namespace chiaro::drivers
