// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

namespace chiaro::daemon {
namespace {

// Under the kernel's threaded interrupts (50), which the loop's packets need.
constexpr int kPriority = 40;

bool set_policy(int policy, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), policy, &parameters) == 0;
}

}  // namespace

bool take_real_time(core::Problems& warnings) {
  // For threads without a real-time turn: the kernel may be 50 us late on purpose, unless told.
  ::prctl(PR_SET_TIMERSLACK, 1);
  const bool turn = set_policy(SCHED_FIFO, kPriority);
  // Locked as touched, not all at once: whole libraries that are never used would count otherwise.
  const bool memory = ::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
  if (!turn)
    warnings.push_back({{},
                        "no permission for real-time scheduling: levels are right, but on a busy "
                        "machine frames may leave up to 5 ms late",
                        "run it as the service chiaro-output, or give your user rtprio in "
                        "/etc/security/limits.conf",
                        true});
  if (!memory)
    warnings.push_back({{},
                        "no permission to lock memory: if the machine swaps, frames may be late",
                        "run it as the service chiaro-output, or give your user memlock in "
                        "/etc/security/limits.conf",
                        true});
  return turn && memory;
}

void take_turn_below_loop() { set_policy(SCHED_FIFO, kPriority - 10); }

void take_ordinary_time() { set_policy(SCHED_OTHER, 0); }

}  // namespace chiaro::daemon
