// SPDX-License-Identifier: Apache-2.0
// A thread for a port whose device may keep its caller waiting: the output loop lays the newest
// frame down and goes on.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <semaphore>
#include <string>
#include <thread>

#include "controller/core/result.h"
#include "controller/daemon/output/jitter.h"
#include "controller/ports/clock.h"
#include "controller/ports/output.h"

namespace chiaro::daemon {

/// One thread puts, one takes; neither ever waits, and the newest wins. Real-time.
class NewestFrame {
 public:
  void put(const ports::DmxFrame& frame) {
    frames_[putting_] = frame;
    putting_ = between_.exchange(putting_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }
  /// The newest frame that has not been taken yet, until the next call; null when there is none.
  const ports::DmxFrame* take() {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return nullptr;
    taking_ = between_.exchange(taking_, std::memory_order_acq_rel) & ~kFresh;
    return &frames_[taking_];
  }

 private:
  static constexpr unsigned kFresh = 4;
  std::array<ports::DmxFrame, 3> frames_;
  unsigned putting_ = 0, taking_ = 1;  ///< each its own thread's
  std::atomic<unsigned> between_{2};
};

/// The thread lives as long as the object and is the only one to touch the port meanwhile; it opens
/// it first.
class PortWriter {
 public:
  /// `real_time`: ask for a turn before ordinary programs'. Both references outlive this.
  PortWriter(ports::OutputPort& port, ports::Clock& clock, ports::Duration period, bool real_time);
  ~PortWriter();
  PortWriter(const PortWriter&) = delete;
  PortWriter& operator=(const PortWriter&) = delete;

  /// The loop's; real-time.
  void put(const ports::DmxFrame& frame) {
    newest_.put(frame);
    wake();
  }
  /// How the port did at its last send; any thread, real-time.
  ports::PortReport report() const;
  /// |gap between two frames on the wire - period| in microseconds: median, 99 and 99.9 per cent.
  /// Of a port that times the wire itself (Open DMX); else nothing. Any thread, real-time.
  std::optional<std::array<double, 3>> jitter_us() const;
  void set_period(ports::Duration period) { period_.store(period, std::memory_order_relaxed); }
  /// Asks for another `open`; any thread.
  void mend() {
    mend_.store(true, std::memory_order_release);
    wake();
  }
  /// False until the port has been opened, well or not, for the first time; any thread.
  bool attempted() const { return attempted_.load(std::memory_order_acquire); }
  /// What opening the port ran into, when that is news; any thread but the loop.
  core::Problems take_problems();

 private:
  void wake() {
    if (!awake_.exchange(true, std::memory_order_acq_rel)) work_.release();
  }
  void run();
  void open();
  void publish();
  void measure(ports::TimePoint left);

  ports::OutputPort& port_;
  ports::Clock& clock_;
  NewestFrame newest_;
  std::binary_semaphore work_{0};
  std::atomic<bool> awake_{false};  ///< the semaphore is up, or about to be taken
  std::atomic<bool> mend_{true}, attempted_{false}, ending_{false};
  std::atomic<ports::PortHealth> health_{ports::PortHealth::closed};
  std::atomic<std::uint64_t> sent_{0}, failed_{0}, reconnects_{0};
  std::atomic<ports::Duration> period_;
  Jitter jitter_;          ///< the thread's
  ports::TimePoint left_;  ///< the thread's
  std::atomic<bool> measured_{false};
  std::array<std::atomic<double>, 3> jitter_us_{};
  std::mutex mutex_;
  core::Problems problems_;
  std::string told_;  ///< the thread's: the same trouble every two seconds is no news
  std::thread thread_;
};

}  // namespace chiaro::daemon
