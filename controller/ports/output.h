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
  TimePoint left{};  ///< when the last frame began to leave, of a port that times the wire itself
};

/// How a motor behind a port stands, by its own word.
struct AxisReport {
  std::uint16_t slot = 0;  ///< 0-based, of the first of its two in the port's universe
  double place = -1;       ///< 0..1 from end to end, beyond when it ran over; -1 = it does not say
  double wanted = 0;       ///< what it is being told
  bool moving = false, homed = false, fault = false;
  bool heard = false;     ///< it answers
  bool can_home = false;  ///< it knows how to find its home
};
/// What a person orders of motors, past the levels.
struct AxisOrder {
  enum class Kind : std::uint8_t {
    stop,     ///< every motor of the port stands still, now
    release,  ///< ends the stop; moves nothing
    home      ///< the motor at `slot` looks for its home
  };
  Kind kind = Kind::stop;
  std::uint16_t slot = 0;
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
  /// The same for a loop that sends many ports in one go: the frame leaves now, or together with
  /// those of other ports at the next `flush` of any of them, before which the port must not be
  /// opened, released or ended. `report` tells of it after that.
  virtual void send_later(const DmxFrame& frame, TimePoint now) { send(frame, now); }
  virtual void flush() {}
  /// Says goodbye where the protocol knows how (sACN: three terminated packets) and closes.
  virtual void release(TimePoint now) = 0;
  virtual PortReport report() const = 0;
  /// Any thread; real-time. A port without motors has nothing to do.
  virtual void order(const AxisOrder&) {}
  /// Any thread.
  virtual std::vector<AxisReport> axes() const { return {}; }
  /// True when `send` may wait for its device. The same for the life of the port.
  virtual bool blocks() const { return false; }
  /// True when bytes can reach real lamps: dry-run never opens such a port.
  virtual bool physical() const = 0;
};

}  // namespace chiaro::ports
