// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/raw_pixels.h"

#include <algorithm>
#include <cmath>

namespace chiaro::drivers {
namespace {

using Pixel = std::array<std::uint8_t, 3>;

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
}

Pixel rgb(int y, int cb, int cr, YcbcrRange range) {
  const bool full = range == YcbcrRange::full;
  const float luma = full ? static_cast<float>(y) : 255.0f / 219 * static_cast<float>(y - 16);
  const float scale = full ? 1.0f : 255.0f / 224;
  const float b = scale * static_cast<float>(cb - 128), r = scale * static_cast<float>(cr - 128);
  return {byte(luma + 1.402f * r), byte(luma - 0.344136f * b - 0.714136f * r),
          byte(luma + 1.772f * b)};
}

std::size_t index(int x, int y, std::size_t stride) {
  return static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
}

}  // namespace

core::EncodedPicture from_yuyv(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride, YcbcrRange range) {
  if (size.width % 2 != 0 || stride < 2 * static_cast<std::size_t>(size.width) ||
      bytes.size() < stride * static_cast<std::size_t>(size.height))
    return {};
  core::EncodedPicture picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; x += 2) {
      const auto* four = &bytes[index(2 * x, y, stride)];
      picture.at(x, y) = rgb(four[0], four[1], four[3], range);
      picture.at(x + 1, y) = rgb(four[2], four[1], four[3], range);
    }
  return picture;
}

core::EncodedPicture from_nv12(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride, YcbcrRange range) {
  const std::size_t luma = stride * static_cast<std::size_t>(size.height);
  if (size.width % 2 != 0 || size.height % 2 != 0 ||
      stride < static_cast<std::size_t>(size.width) || bytes.size() < luma + luma / 2)
    return {};
  core::EncodedPicture picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const auto* chroma = &bytes[luma + index(x / 2 * 2, y / 2, stride)];
      picture.at(x, y) = rgb(bytes[index(x, y, stride)], chroma[0], chroma[1], range);
    }
  return picture;
}

core::EncodedPicture from_grey(std::span<const std::uint8_t> bytes, core::Size size,
                               std::size_t stride) {
  if (stride < static_cast<std::size_t>(size.width) ||
      bytes.size() < stride * static_cast<std::size_t>(size.height))
    return {};
  core::EncodedPicture picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const std::uint8_t grey = bytes[index(x, y, stride)];
      picture.at(x, y) = {grey, grey, grey};
    }
  return picture;
}

}  // namespace chiaro::drivers
