// SPDX-License-Identifier: Apache-2.0
// What a real-time thread must not do, caught in the act: while a `RealTimeSection` lives on a
// thread, memory that is allocated or freed, a lock, a wait, a file, a log or a socket call that
// might wait ends the program with its name (or is counted). guard.cpp stands in for those
// functions of the C library in the whole test program, so that nothing that is linked slips by.
#pragma once

#include <string>
#include <vector>

namespace chiaro::real_time {

enum class OnBreach { abort, count };

/// One at a time on a thread.
class RealTimeSection {
 public:
  explicit RealTimeSection(OnBreach on_breach = OnBreach::abort);
  ~RealTimeSection();
  RealTimeSection(const RealTimeSection&) = delete;
  RealTimeSection& operator=(const RealTimeSection&) = delete;
};

/// What this thread did in its sections that count, in order; at most 64. Forgets them.
std::vector<std::string> breaches();

}  // namespace chiaro::real_time
