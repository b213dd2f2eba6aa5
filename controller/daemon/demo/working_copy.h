// SPDX-License-Identifier: Apache-2.0
// The demo plays on a copy of the shipped studio: what a visitor adds to it (a lamp that was
// learned) stays with the demo and never gets into the installed file.
#pragma once

#include <filesystem>

#include "controller/core/result.h"

namespace chiaro::daemon {

/// The copy of `shipped` in `folder`, made where missing. One that was added to is kept as long as
/// the shipped file is the one that it was made from. Problems: the folder cannot be written.
core::Result<std::filesystem::path> working_copy(const std::filesystem::path& shipped,
                                                 const std::filesystem::path& folder);

}  // namespace chiaro::daemon
