// SPDX-License-Identifier: Apache-2.0
// What an output driver implements: it carries whole DMX universes out of the building.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::ports {

inline constexpr std::size_t kSlots = 512;

/// One universe's levels; slot n of the trade (1..512) is levels[n - 1].
struct DmxFrame {
  std::uint16_t universe = 1;
  std::array<std::uint8_t, kSlots> levels{};
  friend bool operator==(const DmxFrame&, const DmxFrame&) = default;
};

enum class PortHealth : std::uint8_t { closed, good, lost };

struct PortReport {
  PortHealth health = PortHealth::closed;
  std::uint64_t frames_sent = 0, frames_failed = 0, reconnects = 0;
};

/// One output port, used by one thread at a time. Of a port that never `blocks`, `send` is called
/// by the output loop at the port's rate and is real-time: no allocation, lock, log, throw or wait.
/// A port that `blocks` (a serial line, a bus, another daemon) gets a thread of its own, which
/// calls everything: there `send` may wait for its device, and always gets the newest frame there
/// is; those that came meanwhile are passed over. It must come back within about a second, so that
/// the port can be closed. Everything that may fail slowly happens in `open`, which is called
/// again, every two seconds at the latest, while the port's health is not good; it must not leave
/// anything behind when it fails.
class OutputPort {
 public:
  virtual ~OutputPort() = default;
  virtual core::Result<core::Done> open() = 0;
  /// Sends the frame; a failure is counted, never thrown, and the next send tries again.
  virtual void send(const DmxFrame& frame, TimePoint now) = 0;
  /// Says goodbye where the protocol knows how (sACN: three terminated packets) and closes.
  virtual void release(TimePoint now) = 0;
  virtual PortReport report() const = 0;
  /// True when `send` may wait for its device. The same for the life of the port.
  virtual bool blocks() const { return false; }
  /// True when bytes can reach real lamps: dry-run never opens such a port.
  virtual bool physical() const = 0;
};

}  // namespace chiaro::ports
