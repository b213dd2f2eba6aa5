// SPDX-License-Identifier: Apache-2.0
// Zip archives from strangers, and ours. Nothing is ever unpacked to a disk: a member is text in
// memory, and only as much of it as it may be.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::importers {

/// The named member of the archive in `bytes`, at most `most` bytes once inflated. Refused with a
/// sentence: what is no zip or is cut short, an encrypted member, one that claims or turns out to
/// be larger (a bomb), an archive with absurdly many members. `file` stands in the places of
/// problems.
core::Result<std::string> zip_member(const std::string& bytes, const std::string& member,
                                     std::size_t most, const std::string& file);
/// Names of the members. One that is absolute, or climbs out with "..", makes the archive refused.
core::Result<std::vector<std::string>> zip_names(const std::string& bytes, const std::string& file);
/// An archive of these members, name and content, stored in that order.
core::Result<std::string> zip_of(const std::vector<std::pair<std::string, std::string>>& members);

}  // namespace chiaro::importers
