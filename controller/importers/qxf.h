// SPDX-License-Identifier: Apache-2.0
// QLC+ fixture definitions (.qxf): XML whose channels have presets or a group with named ranges.
#pragma once

#include <string>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

/// `file` stands in the places of problems.
core::Result<LibraryFixture> read_qxf(const std::string& text, const std::string& file);

}  // namespace chiaro::importers
