// SPDX-License-Identifier: Apache-2.0
// Pictures from and to files and byte streams. The codecs (OpenCV, OpenEXR) stay behind this door.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "controller/core/picture.h"
#include "controller/core/result.h"

namespace chiaro::core {

/// No picture beyond this is decoded; the header is looked at before any pixel is.
inline constexpr std::size_t kMostPixels = 64u << 20;

/// Reads PNG, JPEG, TIFF, BMP or WebP (grey, CMYK, 16-bit, alpha over mid grey, a JPEG's EXIF
/// orientation applied; of an animated PNG the first picture) to 8-bit sRGB. Every refusal (GIF,
/// animated WebP, HEIC among them) names the file, the reason and what to do.
Result<EncodedPicture> read_picture(const std::filesystem::path& file);
/// The same from memory; `name` stands for the file in problems.
Result<EncodedPicture> decode_picture(std::span<const std::uint8_t> bytes, const std::string& name);

/// As linear light, averaged down by whole steps to at most so many pixels: fifty megapixels would
/// be 600 MB of floats, and light shows in far fewer.
inline constexpr std::size_t kPixelsOfExemplar = 2'000'000;
Picture linear_at_most(const EncodedPicture& picture, std::size_t pixels = kPixelsOfExemplar);

Result<Done> write_png(const std::filesystem::path& file, const EncodedPicture& picture);
Result<Done> write_png(const std::filesystem::path& file, const Grid<std::uint16_t>& ids);
/// Half-float-free OpenEXR: 32-bit channels R, G, B (linear), or one channel Z.
Result<Done> write_exr(const std::filesystem::path& file, const Picture& picture);
Result<Done> write_exr(const std::filesystem::path& file, const Plane& depth);
Result<Picture> read_exr(const std::filesystem::path& file);
/// Linear light from OpenEXR or Radiance (.hdr), which may exceed 1; any other picture decoded.
Result<Picture> read_linear(const std::filesystem::path& file);

std::vector<std::uint8_t> encode_png(const EncodedPicture& picture);
/// quality 1..100.
std::vector<std::uint8_t> encode_jpeg(const EncodedPicture& picture, int quality);

}  // namespace chiaro::core
