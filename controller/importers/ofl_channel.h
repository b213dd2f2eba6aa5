// SPDX-License-Identifier: Apache-2.0
// One channel of an Open Fixture Library fixture: its capabilities as laws.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

/// `slots`: where the mode has its bytes. `finest`: how many bytes the library knows; its raw
/// values count in those unless `dmxValueResolution` says otherwise.
LibraryChannel ofl_channel(const std::string& name, const nlohmann::json& channel,
                           std::vector<int> slots, int finest);

}  // namespace chiaro::importers
