// SPDX-License-Identifier: Apache-2.0
// Files that are either the old or the new version, whatever happens in between.
#pragma once

#include <filesystem>
#include <string>

#include "controller/core/result.h"

namespace chiaro::daemon {

/// Temporary file, fsync, rename, fsync of the folder (made when missing).
core::Result<core::Done> write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace chiaro::daemon
