// SPDX-License-Identifier: Apache-2.0
// The fixed words of a recording, shared by who writes it and who reads it (tape_file.h).
#pragma once

#include <cstdint>
#include <string_view>

namespace chiaro::daemon::tape {

inline constexpr std::string_view kMagic = "CHIAROTAPE\x1a";
inline constexpr std::string_view kBlock = "BLK!";
inline constexpr std::uint8_t kVersion = 1;
/// More than 4096 universes changing in every slot need; what claims more is damaged.
inline constexpr std::uint32_t kLargestBlock = 64u << 20u;
/// No recording lasts longer, nor is there a longer pause in one: 400 days.
inline constexpr std::int64_t kLongest = 400LL * 24 * 3600 * 1'000'000'000;

}  // namespace chiaro::daemon::tape
