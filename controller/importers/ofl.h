// SPDX-License-Identifier: Apache-2.0
// Open Fixture Library fixtures: JSON with available channels, templates for a matrix of pixels,
// and modes that list them.
#pragma once

#include <string>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

/// `maker`: the library keeps it in the folder's name, not in the file; used where the file does
/// not say. `file` stands in the places of problems.
core::Result<LibraryFixture> read_ofl(const std::string& text, const std::string& maker,
                                      const std::string& file);

}  // namespace chiaro::importers
