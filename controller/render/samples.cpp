// SPDX-License-Identifier: Apache-2.0
#include "controller/render/samples.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chiaro::render {

AlignedFloats aligned_floats(std::size_t count) {
  return AlignedFloats(static_cast<float*>(
      ::operator new[](std::max<std::size_t>(count, 16) * sizeof(float), std::align_val_t{64})));
}

namespace {
constexpr std::size_t kNodeFloats = 3 * 6 * Samples::kGroups;  // of one tile
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
  lines_.resize(tiles());
  for (std::size_t tile = 0; tile < tiles(); ++tile) find_lines(tile);
  nodes_ = aligned_floats(node_tiles_ * kNodeFloats);
  std::fill_n(nodes_.get(), node_tiles_ * kNodeFloats, 0.0f);
  for (std::size_t tile = 0; tile < tiles(); ++tile) {
    std::size_t line = 0;
    for (std::uint64_t rest = lines_[tile].groups; rest != 0; rest &= rest - 1, ++line) {
      const std::size_t first =
          tile * kTile + kGroup * static_cast<std::size_t>(std::countr_zero(rest));
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 6; ++c)
          nodes_[lines_[tile].nodes + (6 * k + c) * kGroups + line] =
              channel(static_cast<Channel>(c))[first + kNodes[k]];
    }
  }
}

/// One plane, one row, even steps.
bool Samples::is_line(std::size_t first, float& length) const {
  constexpr float kSameNormal = 1e-5f, kOffTheLine = 5e-3f;
  if (first + kGroup > count_ || pixel_[first + kGroup - 1] - pixel_[first] != kGroup - 1)
    return false;
  const auto width = static_cast<std::uint32_t>(size_.width);
  if (pixel_[first] / width != pixel_[first + kGroup - 1] / width) return false;
  const float* at[3] = {channel(position_x) + first, channel(position_y) + first,
                        channel(position_z) + first};
  const float* normal[3] = {channel(normal_x) + first, channel(normal_y) + first,
                            channel(normal_z) + first};
  float square = 0;
  for (const float* p : at) square += (p[kGroup - 1] - p[0]) * (p[kGroup - 1] - p[0]);
  length = std::sqrt(square);
  for (std::size_t k = 0; k < kGroup; ++k) {
    if (channel(specular)[first + k] > 0) return false;
    const float share = static_cast<float>(k) / (kGroup - 1);
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(normal[c][k] - normal[c][0]) > kSameNormal) return false;
      const float even = at[c][0] + share * (at[c][kGroup - 1] - at[c][0]);
      if (std::abs(at[c][k] - even) > kOffTheLine * length) return false;
    }
  }
  return true;
}

void Samples::find_lines(std::size_t tile) {
  TileLines& found = lines_[tile];
  for (std::size_t g = 0; g < kGroups; ++g) {
    float length = 0;
    if (!is_line(tile * kTile + g * kGroup, length)) continue;
    found.groups |= std::uint64_t{1} << g;
    found.longest = std::max(found.longest, length);
  }
  if (found.groups == 0) return;
  found.nodes = node_tiles_++ * kNodeFloats;
}

Samples::Lines Samples::lines(std::size_t tile) const {
  const TileLines& found = lines_[tile];
  return {found.groups, static_cast<std::size_t>(std::popcount(found.groups)), found.longest,
          nodes_.get() + found.nodes};
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
