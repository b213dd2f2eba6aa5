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

/// How rectangles and disks shade. exact: closed forms. quick: less than half the work, for a
/// search: an expansion about the face's middle. Irradiance is within 0.4 % of what the lamp gives
/// head on; highlights are off by 0.4 % of their top on average (and most, as four points of the
/// face are, where the horizon cuts the face). Exact where the face is large or near, or the
/// surface sharp.
enum class Shading { exact, quick };

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

  /// Groups of sixteen samples in a row of the picture that lie evenly along one line of a plane
  /// and have no gloss, most of a wall or floor: light that varies slowly along them can be worked
  /// out at three of their samples.
  static constexpr std::size_t kGroup = 16, kGroups = kTile / kGroup;
  static constexpr std::size_t kNodes[3] = {0, 8, 15};  ///< which samples
  struct Lines {
    std::uint64_t groups = 0;  ///< a bit for each of the tile's groups
    std::size_t count = 0;
    float longest = 0;  ///< from first to last sample, metres
    /// Of node k (0..2), channel c (position_x .. normal_z), line j: nodes[(6 k + c) kGroups + j].
    const float* nodes = nullptr;
  };
  Lines lines(std::size_t tile) const;

  /// Writes a tile's values to their pixels.
  void scatter(std::size_t tile, const float* values, float* plane) const;

 private:
  core::Size size_;
  std::size_t count_, padded_;
  AlignedFloats values_;
  std::vector<std::uint8_t> glossy_;
  std::vector<std::uint32_t> pixel_;

  void find_lines(std::size_t tile);
  bool is_line(std::size_t first, float& length) const;
  struct TileLines {
    std::uint64_t groups = 0;
    float longest = 0;
    std::size_t nodes = 0;  ///< where they begin
  };
  std::vector<TileLines> lines_;
  std::size_t node_tiles_ = 0;
  AlignedFloats nodes_;
};

}  // namespace chiaro::render
