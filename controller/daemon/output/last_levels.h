// SPDX-License-Identifier: Apache-2.0
// The small file from which the lamps come back after a power cut at exactly the levels they had.
#pragma once

#include <filesystem>
#include <optional>

#include "controller/core/result.h"
#include "controller/rig/governor.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// Levels by fixture name, so that the studio file may change between. Written as a whole or not
/// at all: temporary file, fsync, rename, fsync of the folder.
core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held);

/// What the file holds for this studio: nothing when there is no file or it is another studio's; a
/// warning when it cannot be understood.
std::optional<rig::Held> read_last_levels(const std::filesystem::path& file,
                                          const studio::Studio& studio, core::Problems& warnings);

}  // namespace chiaro::daemon
