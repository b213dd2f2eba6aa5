// SPDX-License-Identifier: Apache-2.0
// Sends a recording again: the same bytes at the same times, as far as the clock is the same.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <vector>

#include "controller/daemon/output/port_slot.h"
#include "controller/daemon/output/tape_file.h"
#include "controller/ports/clock.h"

namespace chiaro::daemon {

struct Replayed {
  std::uint64_t ticks = 0, frames = 0;
  std::map<std::uint16_t, std::uint64_t> nowhere;  ///< frames of universes without a port
  ports::Duration length{};
};

/// Tick by tick from `start` on, until it ends, breaks off or `stop`. `ports`: open, each the
/// universe of its settings.
Replayed replay(TapeReader& tape, const std::vector<std::unique_ptr<PortSlot>>& ports,
                ports::Clock& clock, ports::TimePoint start, const std::atomic<bool>& stop);

}  // namespace chiaro::daemon
