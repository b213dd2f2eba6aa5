// SPDX-License-Identifier: Apache-2.0
// The brain's one I/O loop. Everything the brain knows is thread-bound to it; workers hand their
// results in with `post`.
#pragma once

#include <functional>
#include <memory>

#include "controller/ports/clock.h"

namespace chiaro::panel {

class Loop {
 public:
  Loop();
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// Thread-safe. Runs `work` on the loop's thread, in the order posted.
  void post(std::function<void()> work);
  /// Calls `work` again and again, `period` apart, for as long as the loop lives.
  void every(ports::Duration period, std::function<void()> work);
  /// Until `stop`.
  void run();
  /// Thread-safe.
  void stop();

  struct Io;
  Io& io() { return *io_; }

 private:
  std::unique_ptr<Io> io_;
};

}  // namespace chiaro::panel
