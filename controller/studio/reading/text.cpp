// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/text.h"

#include <cstdint>
#include <cstdio>

#include "controller/core/result.h"

namespace chiaro::studio::reading {

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 48;
  std::string out = "'";
  for (const char c : word.substr(0, kMost))
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  if (word.size() > kMost) {
    // Not in the middle of a UTF-8 character.
    while ((static_cast<unsigned char>(word[out.size() - 1]) & 0xc0u) == 0x80u) out.pop_back();
    out += "…";
  }
  return out + "'";
}

std::string digits(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::string any_of(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return out;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = core::nearest_name(word.substr(0, 100), known);
  if (!nearest.empty()) return "did you mean " + in_quotes(nearest) + "?";
  if (known.empty()) return "there are none here";
  return "known here: " + any_of(known);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

namespace {
/// Length of the UTF-8 character at the front, 0 when there is none (RFC 3629).
std::size_t character(std::string_view b) {
  const auto byte = [&](std::size_t i) {
    return i < b.size() ? static_cast<std::uint8_t>(b[i]) : std::uint8_t{0};
  };
  const std::uint8_t first = byte(0);
  if (first < 0x20) return first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  if (first < 0x80) return first == 0x7f ? 0 : 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) ||
      (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f))
    return 0;
  return length;
}
}  // namespace

std::optional<std::size_t> first_byte_not_text(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t length = character(bytes.substr(i, 4));
    if (length == 0) return i;
    i += length;
  }
  return std::nullopt;
}

}  // namespace chiaro::studio::reading
