// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/made.h"

#include <charconv>
#include <fmt/format.h>

#include "controller/core/picture_header.h"

namespace chiaro::panel {

Made checked(Fields& fields, Gesture gesture) {
  if (auto fault = fields.fault()) return *fault;
  return gesture;
}

std::optional<std::uint64_t> number_of(const std::string& word) {
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return value;
}

Refusal no_such(const std::string& kind, const std::string& word) {
  return {404, fmt::format("there is no {} '{}'", kind, word), word,
          "ask for the list and take a number from it"};
}

std::optional<Refusal> not_a_picture(const std::string& bytes, const std::string& where) {
  const std::span<const std::uint8_t> span(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                           bytes.size());
  const auto problem = core::unlike_a_picture(span, "the picture");
  if (!problem) return std::nullopt;
  return Refusal{422, problem->what, where, problem->remedy};
}

}  // namespace chiaro::panel
