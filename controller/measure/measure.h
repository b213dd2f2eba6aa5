// SPDX-License-Identifier: Apache-2.0
// What a picture's lighting is like, in numbers: pixel types, the thesis's six components and the
// Haar spectrum. Knows nothing of lamps; cannot tell a rendered picture from a photograph.
// Checklist items in brackets, in their right (corrected) forms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "controller/core/gbuffer.h"
#include "controller/core/picture.h"

namespace chiaro::measure {

enum class PixelType : std::uint8_t { background, surface, edge };

/// What the passes over a picture need of a pixel map, worked out once per view: where the edge
/// pixels are, and the run-length scan of the contrast component [I-20].
struct PixelIndex {
  struct Run {
    std::uint32_t begin, end, slot;  ///< pixels begin <= x < end of a row; `slot` numbers the sums
  };
  struct Mark {
    std::uint32_t x, slot;
  };
  /// One meeting of two parts along a row or a column: their runs' slots.
  struct Crossing {
    std::uint32_t first, second;
  };
  std::vector<std::uint32_t> edge_x, edge_row;  ///< edge pixels of row y: edge_row[y]..[y + 1]
  /// Pixels begin <= x < end of a row hold all that is not background; begin == end: nothing.
  struct Span {
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<Span> shown;  ///< one per row
  std::vector<Run> row_runs;
  std::vector<std::uint32_t> row_runs_row;
  std::vector<std::uint32_t> column_begins, column_begins_row;
  std::vector<Mark> column_ends;
  std::vector<std::uint32_t> column_ends_row;
  std::vector<float> run_length;  ///< per slot, pixels
  std::vector<Crossing> crossings;
};

/// Per pixel: EDGE, SURFACE or BACKGROUND [I-8]. EDGE and SURFACE pixels show a subject (or any
/// object, where the view shows no subject at all); BACKGROUND is all the rest. A pixel is EDGE
/// where the Laplacian of inverse depth (0 on every plane), the object id or the normal jumps.
/// External silhouette pixels (subject against background) are marked apart: stage two of the
/// ideal design needs only them.
struct PixelMap {
  core::Grid<PixelType> type;
  core::Grid<std::uint8_t> external;  ///< 1 on edge pixels of a subject's outer silhouette
  std::size_t edges = 0, surfaces = 0, externals = 0;
  PixelIndex index;  ///< belongs to `type`: make a map by the functions below, then leave it
};
struct EdgeThresholds {
  double depth_step = 0.02;   ///< relative to local depth
  double normal_angle = 0.6;  ///< radians between neighbours
};
PixelMap pixel_map(const core::GeometryPlanes& planes, const EdgeThresholds& thresholds = {});
/// For a picture without geometry (a 2D exemplar): every pixel counts, none is an edge.
PixelMap flat_pixel_map(core::Size size);
/// From types decided elsewhere. `part` numbers what each pixel shows (0 = nothing): a run of the
/// contrast scan ends where it changes.
PixelMap pixel_map_of(core::Grid<PixelType> type, core::Grid<std::uint8_t> external,
                      const core::Grid<std::uint16_t>& part);

/// The soft shadow mask [I-9, I-23] from what each pixel sees of each lamp (0..1, the key first).
/// In shadow means: hidden from the key (default), from any lamp, or from all of them.
enum class ShadowRule { key, any, all };
core::Plane lit_mask(std::span<const core::Plane* const> visibility,
                     ShadowRule rule = ShadowRule::key);

/// The working scalar: L* x 2.55, 0..255 [I-22]. Input is display-linear luminance, clipped at 1.
/// Within 1e-4 of the exact curve on every SIMD target; NaN counts as 0.
core::Plane working_scalar(const core::Plane& luminance);

/// The six components on the 0..255 scale [I-14..I-20].
struct Components {
  double edge = 0;      ///< weighted share of edge pixels whose picture gradient shows, 0..1
  double mean = 0;      ///< over surface pixels
  double gradient = 0;  ///< root mean square of |Sobel / 8| over surface pixels
  double variance = 0;  ///< the standard deviation, as in the thesis's tables, over surface pixels
  /// Mean Michelson contrast |a - b| / (a + b), 0..1, over every place where two parts meet along
  /// a row or a column. A part's value is the mean of its run up to the next edge; the edge pixels
  /// between do not enter. A visible wall or floor beside the subject is a part, emptiness is not;
  /// two background parts make no meeting.
  double contrast = 0;
  std::array<double, 256> histogram{};  ///< shares of edge + surface pixels, sum 1
};
struct MeasureOptions {
  double edge_threshold = 8;      ///< grey levels per pixel that count as a detected edge
  double shadow_edge_weight = 2;  ///< edge pixels in shadow weigh more [I-23]
};
/// `lit`: 0 = in cast shadow … 1 = lit, a soft weight for mean and variance [I-23]; may be null.
/// `values`: the working scalar.
/// The picture's border repeats outwards. Where nothing is lit, mean and variance are 0.
Components components(const core::Plane& values, const PixelMap& map,
                      const core::Plane* lit = nullptr, const MeasureOptions& options = {});
/// The same in one pass from display-linear luminance: the hot path, which never stores L*.
Components components_of_luminance(const core::Plane& luminance, const PixelMap& map,
                                   const core::Plane* lit = nullptr,
                                   const MeasureOptions& options = {});
/// All six: false where a component needs geometry and the map is flat (2D exemplars).
bool knows_geometry(const PixelMap& map);

/// Haar coefficients, horizontal and vertical apart, plus the mean [I-31..I-34]: the mean of the
/// left half of a node's square minus that of the right; of the upper half minus the lower. The
/// picture is resampled to side x side, a power of two from 2 on. Level 0 is the whole square
/// (1 node), level n has 4^n; the last has squares of 2 x 2 pixels.
struct HaarSpectrum {
  int side = 0;
  double mean = 0;
  std::vector<std::vector<float>> horizontal, vertical;  ///< per level, row-major nodes
};
HaarSpectrum haar_spectrum(const core::Plane& values, int side = 256);
/// sqrt(weighted mean of squared differences): each level's mean square over its h and v, and the
/// mean's square, weigh the same [I-33 corrected]. Precondition: equal sides.
double haar_distance(const HaarSpectrum& a, const HaarSpectrum& b);
/// As printed in the thesis: h + v summed, no mean, 1/N outside the root.
double haar_distance_as_printed(const HaarSpectrum& a, const HaarSpectrum& b);

/// What by-example aims at. 2D exemplars leave edge and contrast empty [I-29].
struct Targets {
  std::optional<double> edge, mean, gradient, variance, contrast;
  std::optional<std::array<double, 256>> histogram;
};
Targets targets_of(const Components& components, bool geometry_known);

/// What the ideal goal aims at [I-13]; all edges and an equalised histogram go without saying.
/// `gradient` and `contrast` are what the scene can reach at most: found by probing it.
struct IdealTargets {
  double mean = 127.5, variance = 60;  ///< of 0..255: mid grey, a full but unclipped range
  double gradient = 20, contrast = 0.3;
};

/// Half the sum of differences, 0..1; or the earth mover's distance over 255 bins, 0..1, which is
/// kinder to small shifts.
enum class HistogramDistance { half_l1, earth_mover };
double histogram_distance(const std::array<double, 256>& a, const std::array<double, 256>& b,
                          HistogramDistance kind = HistogramDistance::half_l1);

/// The weights w_e w_m w_g w_v w_h w_c; the default is setting 45 of the thesis [I-12].
struct TermWeights {
  double edge = 0.2, mean = 0.8, gradient = 0.2, variance = 0.2, histogram = 0.8, contrast = 0.2;
  HistogramDistance histogram_by = HistogramDistance::half_l1;
};
/// Weighted sum of the terms' costs, each in about 0..1, lower is better; terms whose target is
/// absent do not count. See measure/terms for the formulas.
double perceptual_cost(const Components& now, const Targets& wanted,
                       const TermWeights& weights = {});
/// The same for the ideal goal.
double ideal_cost(const Components& now, const IdealTargets& wanted,
                  const TermWeights& weights = {});

}  // namespace chiaro::measure
