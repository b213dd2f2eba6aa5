// SPDX-License-Identifier: Apache-2.0
#include "controller/render/samples.h"

#include <algorithm>

namespace chiaro::render {

AlignedFloats aligned_floats(std::size_t count) {
  return AlignedFloats(static_cast<float*>(
      ::operator new[](std::max<std::size_t>(count, 16) * sizeof(float), std::align_val_t{64})));
}

Samples::Samples(const core::GBuffer& b)
    : size_(b.size),
      count_(b.samples()),
      padded_((count_ + kTile - 1) / kTile * kTile),
      values_(aligned_floats(kChannels * padded_)),
      glossy_(padded_ / kTile, 0),
      pixel_(b.pixel) {
  const auto fill = [&](Channel c, const std::vector<float>& from, float rest) {
    float* to = values_.get() + static_cast<std::size_t>(c) * padded_;
    std::fill(std::copy(from.begin(), from.end(), to), to + padded_, rest);
  };
  fill(position_x, b.position_x, 0), fill(position_y, b.position_y, 0);
  fill(position_z, b.position_z, 0);
  fill(normal_x, b.normal_x, 0), fill(normal_y, b.normal_y, 0), fill(normal_z, b.normal_z, 1);
  fill(viewer_x, b.viewer_x, 0), fill(viewer_y, b.viewer_y, 0), fill(viewer_z, b.viewer_z, 1);
  fill(diffuse_r, b.diffuse_r, 0), fill(diffuse_g, b.diffuse_g, 0), fill(diffuse_b, b.diffuse_b, 0);
  fill(specular, b.specular, 0), fill(shininess, b.shininess, 1);
  std::vector<float> y(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    y[i] = core::kLuminance[0] * b.diffuse_r[i] + core::kLuminance[1] * b.diffuse_g[i] +
           core::kLuminance[2] * b.diffuse_b[i];
    if (b.specular[i] > 0) glossy_[i / kTile] = 1;
  }
  fill(diffuse_y, y, 0);
}

void Samples::scatter(std::size_t tile, const float* values, float* plane) const {
  const std::size_t first = tile * kTile, n = in_tile(tile);
  if (n == 0) return;
  // Most tiles lie in one unbroken run of pixels.
  if (pixel_[first + n - 1] - pixel_[first] == n - 1) {
    std::copy_n(values, n, plane + pixel_[first]);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) plane[pixel_[first + i]] = values[i];
}

}  // namespace chiaro::render
