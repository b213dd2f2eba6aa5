// SPDX-License-Identifier: Apache-2.0
// The page's own files.
#pragma once

#include <filesystem>

#include "controller/panel/http.h"

namespace chiaro::panel {

/// The file at `path` below `web` ("/" is index.html), never outside of it; where the page has not
/// been built, a short page that says how.
Response file_answer(const std::filesystem::path& web, const std::string& path);

}  // namespace chiaro::panel
