// SPDX-License-Identifier: Apache-2.0
// Frames on their way from the output loop to who writes them down: the loop never waits for a
// disk, and what a disk is too slow for is counted.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "controller/ports/clock.h"
#include "controller/ports/output.h"

namespace chiaro::daemon {

/// One thread puts, one takes; neither waits.
class LiveTape {
 public:
  struct Sent {
    ports::TimePoint at;
    ports::DmxFrame frame;
  };
  /// Room for more than a second and a half of so many universes at 40 Hz; 17 MB at most.
  explicit LiveTape(std::size_t universes)
      : sent_(std::clamp<std::size_t>(universes * 64, 256, 32768)) {}

  // The loop's; real-time.
  /// Asked once a tick, so that a recording begins with a whole one.
  bool runs() const { return on_.load(std::memory_order_acquire); }
  void put(ports::TimePoint at, const ports::DmxFrame& frame) {
    if (!runs()) return;
    const std::uint64_t put = put_.load(std::memory_order_relaxed);
    if (put - taken_.load(std::memory_order_acquire) >= sent_.size()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    sent_[put % sent_.size()] = {at, frame};
    put_.store(put + 1, std::memory_order_release);
  }

  // The other side's.
  void begin() {
    taken_.store(put_.load(std::memory_order_acquire), std::memory_order_release);
    lost_.store(0, std::memory_order_relaxed);
    on_.store(true, std::memory_order_release);
  }
  void end() { on_.store(false, std::memory_order_release); }
  /// The oldest that has not been taken; null when there is none. Valid until `taken`.
  const Sent* oldest() const {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    return taken == put_.load(std::memory_order_acquire) ? nullptr : &sent_[taken % sent_.size()];
  }
  void taken() { taken_.fetch_add(1, std::memory_order_release); }
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

 private:
  std::vector<Sent> sent_;
  std::atomic<std::uint64_t> put_{0}, taken_{0}, lost_{0};
  std::atomic<bool> on_{false};
};

}  // namespace chiaro::daemon
