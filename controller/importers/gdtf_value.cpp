// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/gdtf_value.h"

#include <charconv>

namespace chiaro::importers {

std::optional<std::uint32_t> gdtf_value(std::string_view words, int bytes) {
  const std::size_t slash = words.find('/');
  std::uint64_t value = 0;
  const std::string_view number = words.substr(0, slash);
  const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (code != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  int from = 1;
  bool shifted = false;
  if (slash != std::string_view::npos) {
    std::string_view rest = words.substr(slash + 1);
    if (!rest.empty() && rest.back() == 's') {
      shifted = true;
      rest.remove_suffix(1);
    }
    if (rest.size() != 1 || rest[0] < '1' || rest[0] > '4') return std::nullopt;
    from = rest[0] - '0';
  }
  if (value >> (8u * static_cast<unsigned>(from)) != 0) return std::nullopt;
  for (; from > bytes; --from) value >>= 8u;
  // Mirroring repeats the value's own bytes, from the most significant on, below it.
  const std::uint64_t pattern = value;
  const int own = from;
  for (int i = 0; from < bytes; ++from, ++i) {
    const auto byte = pattern >> (8u * static_cast<unsigned>(own - 1 - i % own)) & 0xffu;
    value = value << 8u | (shifted ? 0 : byte);
  }
  return static_cast<std::uint32_t>(value);
}

}  // namespace chiaro::importers
