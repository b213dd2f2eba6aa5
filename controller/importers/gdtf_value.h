// SPDX-License-Identifier: Apache-2.0
// GDTF's DMXValue: "128/1", "32768/2" or "128/1s".
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace chiaro::importers {

/// The value in a channel of `bytes` (1..3). Without an "s" a value of fewer bytes is mirrored
/// (255/1 is the most of any channel: 65535), with it shifted (65280); of more bytes its upper ones
/// count.
std::optional<std::uint32_t> gdtf_value(std::string_view words, int bytes);

}  // namespace chiaro::importers
