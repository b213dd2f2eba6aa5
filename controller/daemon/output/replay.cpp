// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/replay.h"

#include <algorithm>

namespace chiaro::daemon {
namespace {

/// A pause in a recording must not keep who wants to stop waiting.
constexpr ports::Duration kLongestNap = std::chrono::milliseconds(200);

void wait_until(ports::TimePoint then, ports::Clock& clock, const std::atomic<bool>& stop) {
  for (ports::TimePoint now = clock.now(); now < then && !stop; now = clock.now())
    clock.sleep_until(std::min(then, now + kLongestNap));
}

}  // namespace

Replayed replay(TapeReader& tape, const std::vector<std::unique_ptr<PortSlot>>& ports,
                ports::Clock& clock, ports::TimePoint start, const std::atomic<bool>& stop) {
  Replayed done;
  while (!stop && tape.next()) {
    wait_until(start + tape.at(), clock, stop);
    if (stop) break;
    ++done.ticks;
    done.length = tape.at();
    for (const ports::DmxFrame* frame : tape.sent()) {
      ++done.frames;
      bool sent = false;
      for (const auto& port : ports) {
        if (port->settings().universe != frame->universe) continue;
        port->send(*frame, clock);
        sent = true;
      }
      if (!sent) ++done.nowhere[frame->universe];
    }
    for (const auto& port : ports) port->flush();
  }
  return done;
}

}  // namespace chiaro::daemon
