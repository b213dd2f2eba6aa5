// SPDX-License-Identifier: Apache-2.0
// From an output of the studio file to a driver and its settings.
#pragma once

#include <array>
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

}  // namespace chiaro::daemon
