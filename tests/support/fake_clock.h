// SPDX-License-Identifier: Apache-2.0
// Time as the test says it is, for one thread or for whole programs on threads of their own.
#pragma once

#include <condition_variable>
#include <mutex>
#include <set>

#include "controller/ports/clock.h"

namespace chiaro::support {

/// Thread-safe. Starts at 1000 s, so that "a while ago" is a valid time.
class FakeClock final : public ports::Clock {
 public:
  enum class Sleep {
    jumps,  ///< a sleep moves the time to its deadline at once: one thread, no waiting
    waits   ///< a sleep waits until the test has moved the time: programs on threads
  };
  explicit FakeClock(Sleep sleep = Sleep::waits) : sleep_(sleep) {}

  ports::TimePoint now() const override;
  void sleep_until(ports::TimePoint deadline) override;

  /// Moves the time in one step and wakes who is due.
  void advance(ports::Duration by);
  /// Moves from deadline to deadline until `by` has passed; before each move waits (for real, at
  /// most a minute) until `sleepers` threads are asleep, so that what they do is the same in every
  /// run. Returns false when they did not all fall asleep: a test should fail then.
  bool run_for(ports::Duration by, std::size_t sleepers);
  /// Waits until so many threads are asleep. False after a minute.
  bool wait_for_sleepers(std::size_t sleepers);
  /// From now on every sleep returns at once: lets programs see their stop flag.
  void let_go();

 private:
  std::size_t asleep() const;  // with the mutex held

  const Sleep sleep_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  ports::TimePoint now_{std::chrono::seconds(1000)};
  std::multiset<ports::TimePoint> deadlines_;
  bool let_go_ = false;
};

}  // namespace chiaro::support
