// SPDX-License-Identifier: Apache-2.0
// One thread that does one thing after another, so that the loop never waits.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace chiaro::daemon {

class Worker {
 public:
  Worker() : thread_([this] { run(); }) {}
  /// Finishes what it is doing and forgets the rest.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Thread-safe.
  void add(std::function<void()> task);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool stop_ = false;
  std::thread thread_;
};

/// This thread, and those it starts from now on, run only where nobody else wants the processor
/// (SCHED_IDLE), or normally again. The hand needs the machine more when it has no real-time
/// rights.
void be_modest(bool modest);

}  // namespace chiaro::daemon
