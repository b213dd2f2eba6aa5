// SPDX-License-Identifier: Apache-2.0
// What a term beyond the thesis's six sees and offers, and the table of them all. They stand beside
// any goal, each with a weight: `chiaro design --term NAME=WEIGHT`.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "controller/core/colour.h"
#include "controller/core/units.h"
#include "controller/measure/measure.h"

namespace chiaro::measure::terms {

/// How the surface bends: per pixel the largest angle, in radians, between its normal and those of
/// its neighbours on the same object; 0 elsewhere.
core::Plane curvature_of(const core::GeometryPlanes& planes);

/// Borrowed; null or absent where not known.
struct Seen {
  const core::Plane* luminance = nullptr;  ///< display-linear, never null
  const PixelMap* map = nullptr;           ///< never null
  const core::Plane* curvature = nullptr;
  const core::Picture* colour = nullptr;     ///< absent while only levels are searched
  std::optional<double> key, fill;           ///< lux at the face, of all keys, of all fills
  std::optional<core::Lab> exemplar_chroma;  ///< a*, b* of its mean colour; see chroma_of
};

struct PictureTerm {
  std::string_view name, summary;
  double usual = 0;    ///< wanted unless told otherwise
  core::Range wanted;  ///< what may be wanted
  /// 0 (met) .. 1; nothing where it cannot be told from what is seen.
  std::optional<double> (*cost)(const Seen& seen, double wanted);
};

/// In the order of picture_terms.def.
std::span<const PictureTerm> picture_terms();
const PictureTerm* picture_term(std::string_view name);

/// Calls visit(index) for every pixel of the subject's surfaces.
template <class F>
void each_surface(const PixelMap& map, const F& visit) {
  for (std::size_t i = 0; i < map.type.values.size(); ++i)
    if (map.type.values[i] == PixelType::surface) visit(i);
}
/// L* of the picture as it is shown.
double lightness_at(const Seen& seen, std::size_t pixel);
/// a* and b* of a colour at L* 50, so that brightness does not count. Black has none.
core::Lab chroma_of(core::Rgb colour);

}  // namespace chiaro::measure::terms
