// SPDX-License-Identifier: Apache-2.0
// Problems as the API says them.
#pragma once

#include "controller/panel/state.h"

namespace chiaro::daemon {

/// The first problem in the foreground, all of them in the list.
inline panel::Refusal refusal_of(const core::Problems& problems, int status = 422) {
  const core::Problem first = problems.empty() ? core::Problem{{}, "it failed", ""} : problems[0];
  return {status, first.what, first.where.file.empty() ? "" : core::to_string(first.where),
          first.remedy, problems};
}

}  // namespace chiaro::daemon
