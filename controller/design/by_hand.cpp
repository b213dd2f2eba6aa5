// SPDX-License-Identifier: Apache-2.0
#include "controller/design/by_hand.h"

#include <algorithm>

#include "controller/design/geometric_layers.h"

namespace chiaro::design {
namespace {

// A region darker than this, in mean L*, is nothing to lighten.
constexpr double kBlack = 1;

double mean_lightness(const core::Plane& luminance, const core::Plane& mask) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    const double m = mask.values[i];
    weights += m;
    if (m > 0) sum += m * core::lightness(std::min(1.0, double{luminance.values[i]}));
  }
  return weights > 0 ? sum / weights : 0;
}

/// Why a stroke cannot be carried out.
core::Problems problems_of(const Stroke& stroke, const core::Plane& mask,
                           const core::Plane& unpainted) {
  const std::string on = "paint on " + stroke.region.words + ": ";
  if (std::all_of(mask.values.begin(), mask.values.end(), [](float v) { return v <= 0; }))
    return {{{},
             on + "no pixel of it is in the middle square of the main camera's picture, which "
                  "designs look at",
             "draw it within that square"}};
  if (stroke.stops > 0 && mean_lightness(unpainted, mask) < kBlack)
    return {{{},
             on + "it is black there, and lighter black is black",
             "design a look first and paint on that: \"like\": {\"look\": \"look.json\"} or "
             "{\"mood\": \"rembrandt\"}"}};
  return {};
}

/// What is painted, sought; and what became of each stroke, told: wishes of weight 0.
core::Result<Goal> painted_goal(const studio::Studio& studio, const LayersSource& twin,
                                const GoalByHand& hand, double hold, const studio::Rig& rig,
                                core::Size size, Wishes& told) {
  ExampleGoal goal = painted(studio, twin, rig, hand.strokes, hold, size);
  goal.name = hand.strokes.empty() ? "wishes" : "painted";
  const core::Plane light = core::luminance(goal.exemplar);
  core::Problems problems;
  for (const Stroke& stroke : hand.strokes) {
    const core::Plane mask = mask_of(stroke.region, studio, twin.at(size).geometry(), size);
    for (core::Problem& problem : problems_of(stroke, mask, goal.unpainted))
      problems.push_back(std::move(problem));
    Wish wish;
    wish.region = stroke.region;
    wish.weight = 0;
    wish.wanted = mean_lightness(light, mask);
    told.wishes.push_back(std::move(wish));
  }
  if (!problems.empty()) return problems;
  return Goal(std::move(goal));
}

}  // namespace

core::Problems with_twins(Wishes& wishes, const studio::Studio& studio,
                          const GeometricOptions& options) {
  core::Problems problems;
  for (CameraShare& camera : wishes.cameras) {
    auto twin = layers_of_camera(studio, camera.name, options);
    if (twin) camera.twin = *std::move(twin);
    for (const core::Problem& problem : twin.problems()) problems.push_back(problem);
  }
  return problems;
}

core::Result<Look> design_by_hand(const studio::Studio& studio, const LayersSource& twin,
                                  GoalByHand hand, const std::optional<Goal>& like,
                                  const studio::Rig& rig, Options options) {
  const auto wishes = std::make_shared<Wishes>(*hand.wishes);
  if (!wishes->empty()) options.wishes = wishes;
  options.move_stands = options.move_stands && hand.move.value_or(true);
  if (like && hand.strokes.empty()) return design(studio, twin, *like, options);

  options.start = rig;
  if (like) {
    const auto first = design(studio, twin, *like, options);
    if (!first) return first;
    options.start = first->wanted;
  }
  const bool asks_nothing = !like && hand.strokes.empty() && hand.like == GoalByHand::Like::nothing;
  const auto goal = painted_goal(studio, twin, hand, asks_nothing ? 0 : hand.hold, *options.start,
                                 options.full_size, *wishes);
  if (!goal) return goal.problems();
  if (!wishes->empty()) options.wishes = wishes;
  options.move_stands = options.move_stands && hand.move.value_or(hand.strokes.empty());
  return design(studio, twin, *goal, options);
}

}  // namespace chiaro::design
