// SPDX-License-Identifier: Apache-2.0
// A goal made ready for pictures of one size: what a trial's picture is compared with.
#pragma once

#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/design/design.h"
#include "controller/measure/measure.h"

namespace chiaro::design {

/// The trained eye's size for components that depend on resolution (the gradient is per pixel):
/// targets of 3D exemplars are measured on pictures of 256 x 256.
inline constexpr core::Size kMeasuredSize{256, 256};

struct Pattern;  // pattern.h
struct Asked;    // asked.h

struct Target {
  enum class Kind { ideal, perceptual, wavelet, pattern, painted };
  Kind kind = Kind::ideal;
  core::Size size;

  /// The exemplar at `size`; empty planes in ideal. Display-referred, so 1 is its white.
  core::Picture colour;
  core::Plane luminance;  ///< display-linear
  core::Plane values;     ///< working scalar, 0..255
  /// 1 where the exemplar's own camera clipped: its light is at least this, so that ours costs
  /// nothing when it is at or above.
  core::Grid<std::uint8_t> clipped;
  bool coloured = false;  ///< false for a grey exemplar: it has no opinion on lamp colours

  measure::Targets targets;     ///< by example
  measure::IdealTargets ideal;  ///< else
  measure::TermWeights weights;
  /// True: components are measured on the view's own pixel types; false: on every pixel, as a 2D
  /// exemplar's were [I-19, I-29].
  bool by_geometry = false;
  std::shared_ptr<const Pattern> pattern;  ///< of Kind::pattern
  core::Plane emphasis;                    ///< of Kind::painted: how much each pixel counts
  core::Plane unpainted;                   ///< and its luminance before it was painted
  std::shared_ptr<const Asked> asked;      ///< wishes beside the goal; null: none
};

/// Every reason why a goal cannot be worked with (an empty exemplar, no geometry for ideal).
core::Problems problems_of(const Goal& goal, bool twin_has_geometry);

/// The view is the camera's central square, so the exemplar gives its central square too: a picture
/// from the same camera then lies pixel on pixel.
/// Precondition: problems_of() is empty. Ideal targets for gradient and contrast are only defaults:
/// they depend on what the scene can show, see ideal.h.
/// `planes`: of the view at that size, for goals whose exemplar was matched; may be null.
Target target_of(const Goal& goal, core::Size size, const core::GeometryPlanes* planes = nullptr);

}  // namespace chiaro::design
