// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/picture_terms/picture_term.h"

#include <algorithm>
#include <cmath>

#include "controller/core/geometry.h"
#include "controller/measure/picture_terms/chroma.h"
#include "controller/measure/picture_terms/clipped.h"
#include "controller/measure/picture_terms/cool_warm.h"
#include "controller/measure/picture_terms/curvature_light.h"
#include "controller/measure/picture_terms/entropy.h"
#include "controller/measure/picture_terms/key_fill.h"
#include "controller/measure/picture_terms/relief.h"
#include "controller/measure/picture_terms/silhouette.h"

namespace chiaro::measure::terms {

std::span<const PictureTerm> picture_terms() {
  static constexpr PictureTerm kTerms[] = {
#define PICTURE_TERM(name, summary, usual, least, most) \
  {#name, summary, usual, {least, most}, name##_cost},
#include "controller/measure/picture_terms.def"
#undef PICTURE_TERM
  };
  return kTerms;
}

const PictureTerm* picture_term(std::string_view name) {
  for (const PictureTerm& term : picture_terms())
    if (term.name == name) return &term;
  return nullptr;
}

core::Plane curvature_of(const core::GeometryPlanes& planes) {
  const core::Size size = planes.depth.size;
  core::Plane out(size);
  const auto normal = [&](int x, int y) {
    return core::Vec3{planes.normal_x.at(x, y), planes.normal_y.at(x, y), planes.normal_z.at(x, y)};
  };
  const auto compare = [&](int x, int y, int u, int v) {
    if (u >= size.width || v >= size.height || planes.object.at(x, y) == core::kNothing ||
        planes.object.at(x, y) != planes.object.at(u, v))
      return;
    const double turn = std::acos(std::clamp(core::dot(normal(x, y), normal(u, v)), -1.0, 1.0));
    out.at(x, y) = std::max(out.at(x, y), static_cast<float>(turn));
    out.at(u, v) = std::max(out.at(u, v), static_cast<float>(turn));
  };
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      compare(x, y, x + 1, y);
      compare(x, y, x, y + 1);
    }
  return out;
}

double lightness_at(const Seen& seen, std::size_t pixel) {
  return core::lightness(std::min(1.0, double{seen.luminance->values[pixel]}));
}

core::Lab chroma_of(core::Rgb colour) {
  const double light = core::luminance(colour);
  if (light <= 0) return {};
  core::Lab lab = core::lab_of((core::luminance_of_lightness(50) / light) * colour);
  lab.l = 0;
  return lab;
}

}  // namespace chiaro::measure::terms
