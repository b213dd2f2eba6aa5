// SPDX-License-Identifier: Apache-2.0
// Camera bytes to 8-bit RGB. YCbCr is ITU-R BT.601 as webcams deliver it, of either range.
#pragma once

#include <cstdint>
#include <span>

#include "controller/core/picture.h"

namespace chiaro::drivers {

enum class YcbcrRange { limited, full };

/// `stride`: bytes a row takes. Bytes that are too few leave an empty picture.
core::EncodedPicture from_yuyv(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride, YcbcrRange range);
core::EncodedPicture from_nv12(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride, YcbcrRange range);
core::EncodedPicture from_grey(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride);

}  // namespace chiaro::drivers
