// SPDX-License-Identifier: Apache-2.0
// What the answers of the control socket are made of: refusals with their remedy, and the words of
// a request.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "controller/core/result.h"
#include "controller/rig/wanted.h"

namespace chiaro::daemon {

inline constexpr std::array kMarks{rig::Mark::highlight, rig::Mark::flash, rig::Mark::solo,
                                   rig::Mark::park, rig::Mark::move_in_black};

/// One line of JSON: {"problems": [...]}.
std::string refusal(const core::Problems& problems);
std::string refusal(const std::string& what, const std::string& remedy);
std::string not_in_time();

/// At most so many bytes of it, never half a letter.
std::string cut(const std::string& text, std::size_t most);
/// Takes the first word off `words`.
std::string first_of(std::string& words);
/// A finite number that is not negative, and nothing else.
std::optional<double> number_in(const std::string& word);

}  // namespace chiaro::daemon
