// SPDX-License-Identifier: Apache-2.0
// What the system grants the output loop: a real-time turn and memory that stays.
#pragma once

#include "controller/core/result.h"

namespace chiaro::daemon {

/// For the calling thread: SCHED_FIFO; for the process: memory locked as it is touched. Both or a
/// warning that says what is lost and what to do; then the output goes on without.
bool take_real_time(core::Problems& warnings);

/// For the calling thread: a real-time turn below the loop's, where it is granted. For the thread
/// that brings a blackout: a busy machine must not hold it up.
void take_turn_below_loop();

/// For the calling thread: ordinary scheduling again. Threads inherit their maker's.
void take_ordinary_time();

}  // namespace chiaro::daemon
