// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fake_clock.h"

#include <algorithm>

namespace chiaro::support {

using namespace std::chrono_literals;

ports::TimePoint FakeClock::now() const {
  const std::scoped_lock lock(mutex_);
  return now_;
}

void FakeClock::sleep_until(ports::TimePoint deadline) {
  std::unique_lock lock(mutex_);
  if (sleep_ == Sleep::jumps) {
    now_ = std::max(now_, deadline);
    return;
  }
  if (let_go_ || deadline <= now_) return;
  const auto mine = deadlines_.insert(deadline);
  changed_.notify_all();
  changed_.wait(lock, [&] { return let_go_ || now_ >= deadline; });
  deadlines_.erase(mine);
}

void FakeClock::advance(ports::Duration by) {
  const std::scoped_lock lock(mutex_);
  now_ += by;
  changed_.notify_all();
}

std::size_t FakeClock::asleep() const {
  return static_cast<std::size_t>(std::distance(deadlines_.upper_bound(now_), deadlines_.end()));
}

bool FakeClock::wait_for_sleepers(std::size_t sleepers) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, 60s, [&] { return asleep() >= sleepers; });
}

bool FakeClock::run_for(ports::Duration by, std::size_t sleepers) {
  std::unique_lock lock(mutex_);
  const ports::TimePoint end = now_ + by;
  for (;;) {
    if (!changed_.wait_for(lock, 60s, [&] { return asleep() >= sleepers; })) return false;
    const auto next = deadlines_.upper_bound(now_);
    if (next == deadlines_.end() || *next > end) {
      now_ = end;
      return true;
    }
    now_ = *next;
    changed_.notify_all();
  }
}

void FakeClock::let_go() {
  const std::scoped_lock lock(mutex_);
  let_go_ = true;
  changed_.notify_all();
}

}  // namespace chiaro::support
