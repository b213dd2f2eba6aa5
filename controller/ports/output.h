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

/// One output port. `send` is called by one writer thread at the port's rate; it is real-time: no
/// allocation, lock, log or throw. Everything that may fail slowly happens in `open`.
class OutputPort {
 public:
  virtual ~OutputPort() = default;
  virtual core::Result<core::Done> open() = 0;
  /// Sends the frame; a failure is counted, never thrown, and the next send tries again.
  virtual void send(const DmxFrame& frame, TimePoint now) = 0;
  /// Says goodbye where the protocol knows how (sACN: three terminated packets) and closes.
  virtual void release(TimePoint now) = 0;
  virtual PortReport report() const = 0;
  /// True when bytes can reach real lamps: dry-run never opens such a port.
  virtual bool physical() const = 0;
};

}  // namespace chiaro::ports
