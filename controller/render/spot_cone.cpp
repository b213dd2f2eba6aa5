// SPDX-License-Identifier: Apache-2.0
#include "controller/render/spot_cone.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace chiaro::render {
namespace {

using core::Vec3;

constexpr int kRounds = 200;

Vec3 towards(const core::GBuffer& view, std::size_t i, Vec3 at) {
  return core::unit(Vec3{static_cast<double>(view.position_x[i]),
                         static_cast<double>(view.position_y[i]),
                         static_cast<double>(view.position_z[i])} -
                    at);
}

/// Steps towards the farthest direction, ever shorter: tends to the middle of the narrowest cone
/// (Badoiu and Clarkson 2003).
Vec3 middle_of(const std::vector<Vec3>& directions, double& cosine) {
  Vec3 middle = directions.front();
  for (int round = 1; round <= kRounds; ++round) {
    const Vec3 farthest = *std::min_element(
        directions.begin(), directions.end(),
        [&](Vec3 a, Vec3 b) { return core::dot(a, middle) < core::dot(b, middle); });
    middle = core::unit(middle + (1.0 / (round + 1)) * (farthest - middle));
  }
  cosine = 1;
  for (const Vec3 d : directions) cosine = std::min(cosine, core::dot(d, middle));
  return middle;
}

}  // namespace

std::optional<SpotCone> cone_over(const core::GBuffer& view, std::uint16_t object, Vec3 at) {
  std::vector<Vec3> own;
  for (std::size_t i = 0; i < view.samples(); ++i)
    if (view.object[i] == object) own.push_back(towards(view, i, at));
  if (own.empty()) return std::nullopt;
  SpotCone cone;
  double cosine = 1;
  cone.direction = middle_of(own, cosine);
  if (cosine <= 0) return std::nullopt;
  cone.angle = 2 * std::acos(std::min(1.0, cosine));
  double others = 0, inside = 0;
  for (std::size_t i = 0; i < view.samples(); ++i) {
    const std::uint16_t id = view.object[i];
    if (id == object || id == core::kNothing || !view.objects[id - 1u].subject) continue;
    ++others;
    inside += core::dot(towards(view, i, at), cone.direction) >= cosine;
  }
  cone.spilled = others > 0 ? inside / others : 0;
  return cone;
}

}  // namespace chiaro::render
