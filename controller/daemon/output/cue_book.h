// SPDX-License-Identifier: Apache-2.0
// The cues of a studio in its file: kept whole (whole_file.h), by fixture name, so that they
// outlive restarts and changes of the studio file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "controller/core/result.h"
#include "controller/rig/cue_stack.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// state_folder/cues/<studio>.json
std::filesystem::path cue_file(const std::filesystem::path& state_folder,
                               const studio::Studio& studio);
/// The cues for this studio's fixtures, each looking ahead; none when there is no file; a warning
/// when it cannot be understood.
std::unique_ptr<rig::CueList> read_cues(const std::filesystem::path& state_folder,
                                        const studio::Studio& studio, core::Problems& warnings);
core::Result<core::Done> write_cues(const std::filesystem::path& state_folder,
                                    const studio::Studio& studio, const rig::CueList& list);
/// "2.5"
std::string number_in_words(double number);

}  // namespace chiaro::daemon
