// SPDX-License-Identifier: Apache-2.0
// What a picture's lighting is like, in numbers: pixel types, the thesis's six components and the
// Haar spectrum. Knows nothing of lamps; cannot tell a rendered picture from a photograph.
// Checklist items in brackets, in their right (corrected) forms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "controller/core/gbuffer.h"
#include "controller/core/picture.h"

namespace chiaro::measure {

enum class PixelType : std::uint8_t { background, surface, edge };

/// Per pixel: EDGE, SURFACE or BACKGROUND [I-8], from depth, object id and normals. External
/// silhouette pixels (subject against background) are marked apart: stage two needs only them.
struct PixelMap {
  core::Grid<PixelType> type;
  core::Grid<std::uint8_t> external;  ///< 1 on edge pixels of a subject's outer silhouette
  std::size_t edges = 0, surfaces = 0, externals = 0;
};
struct EdgeThresholds {
  double depth_step = 0.02;   ///< relative to local depth
  double normal_angle = 0.6;  ///< radians between neighbours
};
PixelMap pixel_map(const core::GeometryPlanes& planes, const EdgeThresholds& thresholds = {});
/// For a picture without geometry (a 2D exemplar): every pixel counts, none is an edge.
PixelMap flat_pixel_map(core::Size size);

/// The working scalar: L* x 2.55, 0..255 [I-22]. Input is display-linear luminance, clipped at 1.
core::Plane working_scalar(const core::Plane& luminance);

/// The six components on the 0..255 scale [I-14..I-20]. `edge`: weighted share of edge pixels whose
/// picture gradient shows. `contrast`: mean Michelson contrast of neighbouring parts, 0..1.
struct Components {
  double edge = 0, mean = 0, gradient = 0, variance = 0, contrast = 0;
  std::array<double, 256> histogram{};  ///< shares, sum 1
};
struct MeasureOptions {
  double edge_threshold = 8;      ///< grey levels per pixel that count as a detected edge
  double shadow_edge_weight = 2;  ///< edge pixels in shadow weigh more [I-23]
};
/// `lit`: 0 = in cast shadow … 1 = lit, a soft weight for mean and variance [I-23]; may be null.
/// `values`: the working scalar.
Components components(const core::Plane& values, const PixelMap& map,
                      const core::Plane* lit = nullptr, const MeasureOptions& options = {});

/// Haar coefficients, horizontal and vertical apart, plus the mean [I-31..I-34]. The picture is
/// resampled to side x side, a power of two. Level 0 is the whole square (1 node), level n has 4^n.
struct HaarSpectrum {
  int side = 0;
  double mean = 0;
  std::vector<std::vector<float>> horizontal, vertical;  ///< per level, row-major nodes
};
HaarSpectrum haar_spectrum(const core::Plane& values, int side = 256);
/// sqrt(weighted mean of squared differences over all coefficients and the mean); equal weight per
/// level [I-33 corrected]. Precondition: equal sides.
double haar_distance(const HaarSpectrum& a, const HaarSpectrum& b);
/// As printed in the thesis: h + v summed, no mean, 1/N outside the root.
double haar_distance_as_printed(const HaarSpectrum& a, const HaarSpectrum& b);

/// What by-example aims at. 2D exemplars leave edge and contrast empty [I-29].
struct Targets {
  std::optional<double> edge, mean, gradient, variance, contrast;
  std::optional<std::array<double, 256>> histogram;
};
Targets targets_of(const Components& components, bool geometry_known);

/// The weights w_e w_m w_g w_v w_h w_c; the default is setting 45 of the thesis [I-12].
struct TermWeights {
  double edge = 0.2, mean = 0.8, gradient = 0.2, variance = 0.2, histogram = 0.8, contrast = 0.2;
};
/// Weighted sum of the terms' costs, each in about 0..1, lower is better; terms whose target is
/// absent do not count. See measure/terms for the formulas.
double perceptual_cost(const Components& now, const Targets& wanted,
                       const TermWeights& weights = {});

}  // namespace chiaro::measure
