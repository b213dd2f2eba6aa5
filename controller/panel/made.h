// SPDX-License-Identifier: Apache-2.0
// What the makers of gestures share. Included by sources of the panel only.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "controller/panel/fields.h"
#include "controller/panel/gestures.h"

namespace chiaro::panel {

using Made = std::variant<Gesture, Refusal>;
using Words = std::vector<std::string>;
inline constexpr core::Range kFade{0, 600};

/// `gesture`, unless a field was wrong.
Made checked(Fields& fields, Gesture gesture);
/// A whole number from an address; nothing when it is none.
std::optional<std::uint64_t> number_of(const std::string& word);
Refusal no_such(const std::string& kind, const std::string& word);
/// Refuses bytes that begin like no picture before any job starts on them. Quick: a large one is
/// decoded elsewhere, off the loop.
std::optional<Refusal> not_a_picture(const std::string& bytes, const std::string& where);

// One for each line of routes.def.
#define ROUTE(method, path, what, example, make) \
  Made make(const Request& request, const Words& words, const State& state);
#include "controller/panel/routes.def"
#undef ROUTE

}  // namespace chiaro::panel
