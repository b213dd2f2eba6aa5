// SPDX-License-Identifier: Apache-2.0
// The small file from which the lamps come back after a power cut at exactly the levels they had.
#pragma once

#include <filesystem>
#include <optional>

#include "controller/core/result.h"
#include "controller/daemon/output/whole_file.h"
#include "controller/rig/governor.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// The newest and four before it.
inline constexpr int kLevelGenerations = 5;

/// Levels by fixture name, so that the studio file may change between. Written as a whole or not
/// at all (whole_file.h), and signed with a checksum.
core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held);
core::Result<core::Done> write_last_levels(const std::filesystem::path& file,
                                           const studio::Studio& studio, const rig::Held& held,
                                           FileCalls& calls);

/// What the newest whole generation holds for this studio: nothing when there is none or it is
/// another studio's; a warning for each that cannot be understood.
std::optional<rig::Held> read_last_levels(const std::filesystem::path& file,
                                          const studio::Studio& studio, core::Problems& warnings);

}  // namespace chiaro::daemon
