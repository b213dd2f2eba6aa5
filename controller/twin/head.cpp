// SPDX-License-Identifier: Apache-2.0
#include "controller/twin/head.h"

#include <algorithm>
#include <array>
#include <optional>

namespace chiaro::twin {
namespace {

using core::Vec3;

constexpr std::size_t kSlabs = 64;
struct Span {
  double least = 1e300, most = -1e300;
  void include(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  double width() const { return most < least ? 0 : most - least; }
};
using Profile = std::array<Span, kSlabs>;  ///< from the lowest slab upwards

Vec3 vertex(const Mesh& mesh, std::size_t i) {
  return {mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]};
}

Profile profile(const Mesh& mesh, Vec3 across, const core::Box3& box) {
  Profile out;
  const double slab = box.extent().z / kSlabs;
  const auto number = [&](double z) {
    return std::min<std::size_t>(kSlabs - 1,
                                 static_cast<std::size_t>(std::max(0.0, (z - box.least.z) / slab)));
  };
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    Span z, side;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = vertex(mesh, mesh.indices[3 * t + k]);
      z.include(p.z);
      side.include(dot(p, across));
    }
    for (std::size_t s = number(z.least); s <= number(z.most); ++s) {
      out[s].include(side.least);
      out[s].include(side.most);
    }
  }
  return out;
}

/// The slab of the neck: going down from the top, the narrowest place after the head's widest and
/// before the shoulders.
std::optional<std::size_t> neck(const Profile& widths) {
  constexpr std::size_t kLowest = kSlabs / 4;  // a waist is not a neck
  double head = 0, narrowest = 1e300;
  std::size_t at = kSlabs;
  for (std::size_t s = kSlabs; s-- > kLowest;) {
    const double width = widths[s].width();
    if (at == kSlabs && width >= head) head = width;
    if (head > 0 && width < 0.9 * head && width < narrowest && s + 3 < kSlabs) {
      narrowest = width;
      at = s;
    }
    if (at != kSlabs && width > 1.4 * narrowest && width > 1.15 * head) return at;
  }
  return std::nullopt;
}

}  // namespace

core::Box3 bounds_of(const Mesh& mesh) {
  core::Box3 box;
  for (std::size_t i = 0; i < mesh.positions.size() / 3; ++i) box.include(vertex(mesh, i));
  return box;
}

Vec3 head_centre(const Mesh& mesh, Vec3 across) {
  const core::Box3 box = bounds_of(mesh);
  if (box.extent().z <= 0) return box.centre();
  const auto at = neck(profile(mesh, across, box));
  if (!at) return box.centre();
  const double chin = box.least.z + box.extent().z * static_cast<double>(*at + 1) / kSlabs;
  core::Box3 head;
  for (std::size_t i = 0; i < mesh.positions.size() / 3; ++i)
    if (const Vec3 p = vertex(mesh, i); p.z >= chin) head.include(p);
  return head.empty() ? box.centre() : head.centre();
}

}  // namespace chiaro::twin
