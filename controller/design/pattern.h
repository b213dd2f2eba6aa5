// SPDX-License-Identifier: Apache-2.0
// The light on another person's face, compared with the light on ours. Skin, hair, clothes, framing
// and background differ; what carries over is how the light falls across the face, coarsely, how
// the rest of the person stands to it, and how bright the background is, here and there.
//
// A picture becomes some three hundred means of display-linear luminance: 16 x 16 cells over the
// face's box, 8 x 8 over the rest of the subject, 3 x 2 fields of background. They are compared in
// L*. The face's differences go through a Haar pyramid, so that what is finer than 1/16 of the face
// does not count, and are split into what is alike on both halves of a face and what is not: skin,
// brows and beard are alike, light is not, so the second weighs more.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "controller/core/gbuffer.h"
#include "controller/design/align.h"
#include "controller/design/levels.h"

namespace chiaro::design {

/// An exemplar laid on our subject: what the pictures of every size are made from.
struct Matched {
  FaceBox ours;
  core::Picture aligned;    ///< the exemplar where our subject is, square
  core::Plane foreground;   ///< beside `aligned`: share of the exemplar's subject; empty: unknown
  core::Picture own_frame;  ///< the exemplar's central square as it stands
  core::Plane behind;       ///< beside it: 1 where it shows background; empty: unknown
  /// The exemplar's face was found, or is known: else it lies on our subject by its outline or as
  /// it is framed, and what fits there may be anything.
  bool by_face = true;
};

inline constexpr int kFaceCells = 16, kBodyCells = 8;
inline constexpr std::uint16_t kNoCell = 0xffff;

/// What pictures of one size are compared by.
struct Pattern {
  core::Size size;
  std::vector<std::uint16_t> cell;    ///< per pixel, into the lists below, or kNoCell
  std::vector<float> wanted;          ///< working scalar
  std::vector<float> pixels;          ///< how many there are in our picture; 0: does not count
  std::vector<std::uint8_t> clipped;  ///< the exemplar's camera clipped: at least `wanted`
  bool by_face = true;                ///< see Matched
};
/// `planes` null: no geometry is known, so every pixel in the face's ellipse counts as face and the
/// rest as body.
Pattern pattern_of(const Matched& matched, const core::GeometryPlanes* planes, core::Size size);

/// How much brighter a picture's background is than the exemplar's own, working scalar, mean; 0
/// where either is not known. `values`: working scalar, of the pattern's size.
double background_off(const Pattern& pattern, const core::Plane& values);

/// Levels by pattern: Gauss-Newton on the means' L*, from a linear start.
class PatternLevels : public LevelSolver {
 public:
  explicit PatternLevels(const Pattern& pattern);
  Levels solve(const Columns& columns, Effort effort) override;
  double cost(const Columns& columns, std::span<const double> levels) override;

 private:
  using Means = std::vector<double>;  ///< one per cell
  void reduce(const Columns& columns);
  Means mean_of(const core::Plane& plane) const;
  /// Differences in the working scalar, and d(working scalar)/dY where a change would show.
  void compare(std::span<const double> levels);
  double cost_of(std::span<const double> levels);
  bool step(const Columns& columns, Levels& now);
  std::vector<double> start(const Columns& columns);

  const Pattern& pattern_;
  Means offset_, difference_, slope_;
  std::vector<Means> columns_;
};

}  // namespace chiaro::design
