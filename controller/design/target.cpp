// SPDX-License-Identifier: Apache-2.0
#include "controller/design/target.h"

#include <algorithm>
#include <cmath>

#include "controller/design/pattern.h"

namespace chiaro::design {
namespace {

// 254 of 255, decoded: a sensor's or a JPEG's last step is as good as clipped.
const double kClipped = core::srgb_linear(253.5 / 255.0);
// Chroma below this (mean of max - min over channels, encoded) is a grey picture with JPEG noise.
constexpr double kGreyChroma = 0.012;

core::Plane central_square(const core::Plane& plane) {
  const int side = std::min(plane.size.width, plane.size.height);
  const int left = (plane.size.width - side) / 2, top = (plane.size.height - side) / 2;
  core::Plane square(core::Size{side, side});
  for (int y = 0; y < side; ++y) std::copy_n(plane.row(y + top) + left, side, square.row(y));
  return square;
}

core::Picture central_square(const core::Picture& picture) {
  core::Picture square;
  square.red = central_square(picture.red);
  square.green = central_square(picture.green);
  square.blue = central_square(picture.blue);
  return square;
}

core::Grid<std::uint8_t> clipped_pixels(const core::Picture& picture) {
  core::Grid<std::uint8_t> mask(picture.size());
  for (std::size_t i = 0; i < mask.values.size(); ++i)
    mask.values[i] = std::max({picture.red.values[i], picture.green.values[i],
                               picture.blue.values[i]}) >= static_cast<float>(kClipped);
  return mask;
}

bool has_colour(const core::Picture& picture) {
  double sum = 0;
  for (std::size_t i = 0; i < picture.red.values.size(); ++i) {
    const auto [low, high] =
        std::minmax({picture.red.values[i], picture.green.values[i], picture.blue.values[i]});
    sum += core::srgb_encoded(high) - core::srgb_encoded(low);
  }
  return sum > kGreyChroma * static_cast<double>(picture.red.values.size());
}

/// A gradient measured per pixel of a 256 x 256 picture, as it is per pixel at another size: scaled
/// by what the exemplar itself does when resized.
double gradient_at_size(double gradient, const core::Picture& exemplar, const Target& target) {
  const core::Plane full =
      measure::working_scalar(core::luminance(core::resized(exemplar, kMeasuredSize)));
  const double there = measure::components(full, measure::flat_pixel_map(kMeasuredSize)).gradient;
  const double here =
      measure::components(target.values, measure::flat_pixel_map(target.size)).gradient;
  return there > 0 ? gradient * here / there : gradient;
}

measure::Targets targets_for(const ExampleGoal& goal, const core::Picture& exemplar,
                             const Target& target) {
  if (!goal.targets3d)
    return measure::targets_of(
        measure::components(target.values, measure::flat_pixel_map(target.size)), false);
  measure::Targets targets = *goal.targets3d;
  if (targets.gradient && !(target.size == kMeasuredSize))
    targets.gradient = gradient_at_size(*targets.gradient, exemplar, target);
  return targets;
}

Target ideal_target(const IdealGoal& goal, core::Size size) {
  Target target;
  target.kind = Target::Kind::ideal;
  target.size = size;
  target.weights = goal.weights;
  target.by_geometry = true;
  return target;
}

}  // namespace

core::Problems problems_of(const Goal& goal, bool twin_has_geometry) {
  core::Problems problems;
  if (const auto* example = std::get_if<ExampleGoal>(&goal)) {
    if (example->exemplar.size().pixels() == 0)
      problems.push_back({{}, "the reference picture is empty", "choose another picture"});
  } else if (!twin_has_geometry) {
    problems.push_back({{},
                        "ideal lighting needs the subject's shape, and this studio has none",
                        "give the studio file a mesh or a stand-in, or light by example"});
  }
  return problems;
}

Target target_of(const Goal& goal, core::Size size, const core::GeometryPlanes* planes) {
  if (const auto* ideal = std::get_if<IdealGoal>(&goal)) return ideal_target(*ideal, size);
  const auto& example = std::get<ExampleGoal>(goal);
  Target target;
  target.kind = example.objective == Objective::wavelet   ? Target::Kind::wavelet
                : example.objective == Objective::painted ? Target::Kind::painted
                                                          : Target::Kind::perceptual;
  target.size = size;
  const core::Picture exemplar = central_square(example.exemplar);
  target.colour = core::resized(exemplar, size);
  target.luminance = core::luminance(target.colour);
  target.values = measure::working_scalar(target.luminance);
  target.clipped = clipped_pixels(target.colour);
  target.coloured = example.follow_colour && has_colour(target.colour);
  target.weights = example.weights;
  target.by_geometry = example.targets3d.has_value();
  target.targets = targets_for(example, exemplar, target);
  if (target.kind == Target::Kind::painted) {
    target.emphasis = core::resized(example.emphasis, size);
    target.unpainted = core::resized(example.unpainted, size);
  }
  if (example.matched && target.kind == Target::Kind::wavelet) {
    target.kind = Target::Kind::pattern;
    target.pattern = std::make_shared<const Pattern>(pattern_of(*example.matched, planes, size));
  }
  return target;
}

}  // namespace chiaro::design
