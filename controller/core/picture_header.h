// SPDX-License-Identifier: Apache-2.0
// What the first bytes of a picture say before any pixel is decoded: cheap enough for a thread that
// must not wait.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "controller/core/result.h"

namespace chiaro::core {

/// Why a picture that begins so is not read: empty, HEIC, GIF, animated, too many pixels or none.
/// Nothing when it is worth decoding; it may still be damaged. `name` stands for the file.
std::optional<Problem> header_problem(std::span<const std::uint8_t> bytes, const std::string& name);
/// As above, and the bytes must begin like PNG, JPEG, TIFF, BMP or WebP.
std::optional<Problem> unlike_a_picture(std::span<const std::uint8_t> bytes,
                                        const std::string& name);

}  // namespace chiaro::core
