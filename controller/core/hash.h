// SPDX-License-Identifier: Apache-2.0
// Content fingerprints: of a studio (brain and hand must agree) and of a mesh (its prepared copy).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace chiaro::core {

/// 64-bit FNV-1a. Not for adversaries: it tells versions apart.
class Fingerprint {
 public:
  Fingerprint& add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t b : bytes) value_ = (value_ ^ b) * 0x100000001b3ULL;
    return *this;
  }
  Fingerprint& add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ULL;
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};
/// 16 lower-case hexadecimal digits.
std::string hex(std::uint64_t value);

}  // namespace chiaro::core
