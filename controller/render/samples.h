// SPDX-License-Identifier: Apache-2.0
// A view's samples laid out for vector kernels: aligned, padded, only what shading reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "controller/core/gbuffer.h"

namespace chiaro::render {

/// Samples are worked on in tiles whose arrays stay in the first-level cache together.
inline constexpr std::size_t kTile = 1024;

struct AlignedDelete {
  void operator()(float* p) const { ::operator delete[](p, std::align_val_t{64}); }
};
using AlignedFloats = std::unique_ptr<float[], AlignedDelete>;
AlignedFloats aligned_floats(std::size_t count);

/// Immutable after construction; thread-safe.
class Samples {
 public:
  explicit Samples(const core::GBuffer& buffer);

  enum Channel {
    position_x,
    position_y,
    position_z,
    normal_x,
    normal_y,
    normal_z,
    viewer_x,
    viewer_y,
    viewer_z,
    diffuse_r,
    diffuse_g,
    diffuse_b,
    diffuse_y,  ///< luminance of the albedo
    specular,
    shininess,
    kChannels
  };
  /// Values beyond count() up to a multiple of kTile are harmless: albedo 0, a normal up.
  const float* channel(Channel c) const {
    return values_.get() + static_cast<std::size_t>(c) * padded_;
  }
  std::size_t count() const { return count_; }
  std::size_t tiles() const { return padded_ / kTile; }
  std::size_t in_tile(std::size_t tile) const {
    return std::min(kTile, count_ - std::min(count_, tile * kTile));
  }
  bool glossy(std::size_t tile) const { return glossy_[tile] != 0; }  ///< any specular > 0
  core::Size size() const { return size_; }
  bool fills_picture() const { return count_ == size_.pixels(); }

  /// Writes a tile's values to their pixels.
  void scatter(std::size_t tile, const float* values, float* plane) const;

 private:
  core::Size size_;
  std::size_t count_, padded_;
  AlignedFloats values_;
  std::vector<std::uint8_t> glossy_;
  std::vector<std::uint32_t> pixel_;
};

}  // namespace chiaro::render
