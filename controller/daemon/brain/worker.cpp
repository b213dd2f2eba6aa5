// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/worker.h"

#include <sched.h>

namespace chiaro::daemon {

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::add(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !tasks_.empty(); });
    if (stop_) return;
    const auto task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

void be_modest(bool modest) {
  const sched_param none{};
  sched_setscheduler(0, modest ? SCHED_IDLE : SCHED_OTHER, &none);
}

}  // namespace chiaro::daemon
