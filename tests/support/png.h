// SPDX-License-Identifier: Apache-2.0
// A PNG writer that shares no code with the product: stored (uncompressed) data, any colour type
// and depth, headers that lie on request.
#pragma once

#include <cstdint>
#include <vector>

namespace chiaro::support {

enum class PngColour : std::uint8_t { grey = 0, rgb = 2, grey_alpha = 4, rgba = 6 };

/// `samples` row after row, each 8 or 16 bits as `bits` says; the header claims `width` x `height`
/// whatever there is.
std::vector<std::uint8_t> png(std::uint32_t width, std::uint32_t height, PngColour colour, int bits,
                              const std::vector<std::uint16_t>& samples);

}  // namespace chiaro::support
