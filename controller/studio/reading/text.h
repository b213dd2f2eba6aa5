// SPDX-License-Identifier: Apache-2.0
// Small words about text that every reader needs: quoting what a user wrote, numbers as people
// write them, and whether bytes are text at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro::studio::reading {

/// 'like this', cut short and with control characters replaced: hostile names reach terminals.
std::string in_quotes(std::string_view word);
/// At most six significant digits, no trailing zeros: 0.6, 12000, 1.3.
std::string digits(double number);
/// "a, b or c".
std::string any_of(const std::vector<std::string>& words);
/// " - did you mean 'x'?" or what the choices are when nothing is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);
std::string_view trimmed(std::string_view text);
/// Offset of the first byte that UTF-8 text cannot hold (controls other than tab and line ends).
std::optional<std::size_t> first_byte_not_text(std::string_view bytes);

}  // namespace chiaro::studio::reading
