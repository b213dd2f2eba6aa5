// SPDX-License-Identifier: Apache-2.0
// GDTF 1.2 (DIN SPEC 15800): a zip with description.xml. Modes, channel functions, emitters, the
// beam and the geometry tree; photometry that is only the format's default is marked as assumed.
#pragma once

#include <string>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

core::Result<LibraryFixture> read_gdtf(const std::string& bytes, const std::string& file);
/// The description alone, as it lies in the archive.
core::Result<LibraryFixture> read_gdtf_description(const std::string& xml, const std::string& file);

}  // namespace chiaro::importers
