// SPDX-License-Identifier: Apache-2.0
// Judges of lighting that share no term with any objective of the design engine: three that say how
// alike two pictures of the same subject are lit, and four that say how well one picture shows it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "controller/core/gbuffer.h"
#include "controller/core/picture.h"
#include "controller/measure/measure.h"

namespace chiaro::daemon::study {

/// What there is to see, from the camera that took both pictures.
struct Subject {
  const core::GeometryPlanes& planes;
  const measure::PixelMap& map;
};

/// 0 = alike; larger is less alike. Planes are display-linear luminance of the subject's size.
/// The illumination on a ball: nine spherical harmonics of the normals fitted to the subject's
/// pixels (Ramamoorthi and Hanrahan 2001); the distance of the two, relative to the first.
double illumination_distance(const Subject& subject, const core::Plane& a, const core::Plane& b);
/// 1 - CW-SSIM (Sampat, Wang, Gupta, Bovik and Markey 2009) of the lightness, over the subject:
/// structure in 3 scales and 4 directions, blind to small shifts.
double structure_distance(const Subject& subject, const core::Plane& a, const core::Plane& b);
/// Earth mover's distance between the light of 5 x 5 regions of the subject, in widths of its box;
/// light that one has more of is carried from as far as there is (Pele and Werman 2008).
double region_distance(const Subject& subject, const core::Plane& a, const core::Plane& b);

struct Judge {
  std::string_view name;
  double (*distance)(const Subject&, const core::Plane&, const core::Plane&);
};
inline constexpr std::array<Judge, 3> kJudges{{{"illumination", illumination_distance},
                                               {"structure", structure_distance},
                                               {"regions", region_distance}}};

/// The least cost of carrying `from` to `to`, of equal sums, over the costs of each way
/// (row-major); exact, by successive shortest ways.
double transport_cost(std::vector<double> from, std::vector<double> to,
                      const std::vector<double>& cost);

/// How well one picture shows the subject.
struct Shown {
  double shape = 0;    ///< rank correlation of shading and curvature over surface pixels, -1..1
  double edges = 0;    ///< F1 of the picture's edges against the id map's, a pixel's tolerance
  double entropy = 0;  ///< of the subject's grey levels, bits, 0..8
  double clipped = 0;  ///< share of the subject's pixels that are black or white
};
Shown shown(const Subject& subject, const core::Plane& luminance);
/// One number, 0..1: the mean of shape, edges and entropy / 8, less the clipped share.
double overall(const Shown& shown);

}  // namespace chiaro::daemon::study
