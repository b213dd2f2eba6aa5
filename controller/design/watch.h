// SPDX-License-Identifier: Apache-2.0
// Time, cancellation and progress of one design. Time is asked of the caller's clock only.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include "controller/design/design.h"

namespace chiaro::design {

/// Thread-safe.
class Watch {
 public:
  explicit Watch(const Options& options);

  /// Looks at the clock and at the caller's stop flag; true from then on once either says so.
  bool over();
  /// For the optimiser: raised by over().
  const std::atomic<bool>* flag() const { return &over_; }
  /// By the budget, not by the caller.
  bool out_of_time() const { return out_of_time_; }
  bool stopped() const { return over_; }
  double elapsed() const;

  /// Names the stage and how many trials it may take; trials before it keep counting.
  void begin(const std::string& stage, std::uint64_t trials);
  /// Trials so far and the best cost of this stage.
  void report(std::uint64_t trials, double best);
  /// Ends the stage with the trials it really took.
  void end(std::uint64_t trials);
  std::uint64_t trials() const { return done_; }

 private:
  const Options& options_;
  double started_ = 0;
  std::atomic<bool> over_ = false, out_of_time_ = false;
  std::mutex mutex_;
  std::string stage_;
  std::uint64_t done_ = 0, expected_ = 0;
};

}  // namespace chiaro::design
