// SPDX-License-Identifier: Apache-2.0
// One fixture file of any library, by its ending.
#pragma once

#include <filesystem>
#include <string>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

/// .qxf, .gdtf or .json (Open Fixture Library). The profile that reading made, or one problem that
/// says why not; never throws on bad input.
core::Result<Imported> import_fixture(const std::filesystem::path& file);
/// The same from bytes; `ending` with its dot.
core::Result<Imported> import_fixture(const std::string& bytes, const std::string& ending,
                                      const std::string& maker, const std::string& file);
/// The whole file; at most 256 MB.
core::Result<std::string> bytes_of(const std::filesystem::path& file);

}  // namespace chiaro::importers
