// SPDX-License-Identifier: Apache-2.0
// Who we are on the network: sACN receivers tell sources apart by a CID that must outlive restarts.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "controller/core/result.h"

namespace chiaro::daemon {

using Cid = std::array<std::uint8_t, 16>;

/// "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx".
std::string to_text(const Cid& cid);

/// The CID in the state folder; a new random UUID (version 4) is kept there the first time. When
/// it cannot be kept, a warning.
Cid kept_cid(const std::filesystem::path& state_folder, core::Problems& warnings);

}  // namespace chiaro::daemon
