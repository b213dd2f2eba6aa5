// SPDX-License-Identifier: Apache-2.0
// From an output of the studio file to a driver and its settings.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "controller/studio/studio.h"
#include "drivers/registry.h"

namespace chiaro::daemon {

struct PortPlan {
  std::string driver;
  drivers::OutputSettings settings;
  double rate_hz = 40;
};

/// `output` is one of the studio's. Ports that share an interface learn of each other: one of them
/// speaks for all.
PortPlan plan_of(const studio::Studio& studio, const studio::Output& output,
                 const std::array<std::uint8_t, 16>& cid);

/// The port, open if it can be without waiting for its device (else its own thread opens it); in a
/// dry run nothing that could reach a lamp is even made. What keeps it from opening now is a
/// warning: it is tried again.
std::unique_ptr<ports::OutputPort> open_port(const PortPlan& plan, bool dry_run,
                                             drivers::Surroundings& around,
                                             core::Problems& warnings);

}  // namespace chiaro::daemon
