// SPDX-License-Identifier: Apache-2.0
#include "controller/design/match.h"

#include <algorithm>
#include <cmath>

#include "controller/design/foreground.h"
#include "controller/design/stages.h"

namespace chiaro::design {
namespace {

// The sitter of the shipped moods (config/subjects/bust.yaml).
constexpr core::Rgb kDrawnSkin{0.62, 0.48, 0.40};
// People's skin, all of them, in luminance: the middle and one standard deviation in stops. And how
// far from the meter's reading portraits are exposed on purpose.
constexpr double kUsualSkin = 0.36, kSkinStops = 1.0, kExposureStops = 0.8;
// Skin that faces a lamp at the meter's reading and a little aside of it.
constexpr double kFacing = 0.92;
constexpr core::Range kSkins{0.04, 0.85};
// The brightest part of a face by which its exposure is read, and what is too bright to be read.
constexpr double kLitShare = 0.3;
// A sitter turned less than this looks the same both ways round; a mirrored exemplar must fit that
// much better to be taken so.
const double kTurned = core::radians(12);
constexpr double kBetterMirrored = 0.9;

core::Rgb skin_of(double reflectance) {
  return (reflectance / core::luminance(kDrawnSkin)) * kDrawnSkin;
}

bool same_skin(const studio::Studio& studio, core::Rgb skin) {
  return std::all_of(studio.subjects.begin(), studio.subjects.end(), [&](const auto& subject) {
    return subject.material && subject.material->diffuse == skin;
  });
}

/// Luminance of the lit part of an exemplar's face.
double lit_of(const core::Picture& aligned, const FaceBox& face) {
  const core::Plane light = core::luminance(aligned);
  std::vector<float> inside;
  for (int y = 0; y < light.size.height; ++y)
    for (int x = 0; x < light.size.width; ++x) {
      const double u = ((x + 0.5) / light.size.width - face.x) / face.side,
                   v = ((y + 0.5) / light.size.height - face.y) / face.side;
      if (u * u / 0.16 + v * v / 0.2 < 1) inside.push_back(light.at(x, y));
    }
  if (inside.empty()) return kUsualSkin;
  std::sort(inside.begin(), inside.end());
  const auto first = static_cast<std::size_t>((1 - kLitShare) * static_cast<double>(inside.size()));
  double sum = 0;
  for (std::size_t i = first; i < inside.size(); ++i) sum += double{inside[i]};
  return sum / static_cast<double>(inside.size() - first);
}

ExampleGoal laid_on(const ExampleGoal& goal, const Alignment& alignment, const FaceBox& ours,
                    const Window& window, bool normalise) {
  ExampleGoal laid = goal;
  laid.exemplar = seen_through(goal.exemplar, window, kMeasuredSize);
  if (!normalise) return laid;
  auto pair = std::make_shared<Matched>();
  pair->ours = ours;
  pair->aligned = laid.exemplar;
  pair->own_frame = seen_through(goal.exemplar, Window{}, kMeasuredSize);
  pair->by_face = alignment.by == Alignment::By::face;
  if (!alignment.foreground.empty()) {
    pair->foreground = seen_through(alignment.foreground, window, kMeasuredSize);
    pair->behind = core::resized(alignment.foreground, kMeasuredSize);
    for (float& v : pair->behind.values) v = 1 - v;
  }
  if (window.mirrored)
    for (core::Plane* plane :
         {&pair->own_frame.red, &pair->own_frame.green, &pair->own_frame.blue, &pair->behind})
      if (!plane->empty()) *plane = seen_through(*plane, {0.5, 0.5, 1, true}, kMeasuredSize);
  laid.matched = std::move(pair);
  return laid;
}

/// Across about our frame's middle: the exemplar's own window, read from the other side.
Window mirrored(const Window& window, const FaceBox& ours, const FaceBox& theirs) {
  Window other = window;
  other.mirrored = true;
  // A point at `ours.x` of our frame must still show their face.
  other.x = theirs.x + window.side * (ours.x - 0.5);
  return other;
}

/// How well a first rough rig can show the goal.
double rough_cost(const studio::Studio& studio, const LayersSource& compared, const Goal& goal,
                  const Options& options, const Variables& all, Watch& watch) {
  const Layers& layers = compared.at(options.search_size);
  const Sizes rough = prepare(studio, goal, all, layers, layers, layers);
  const Setting setting{studio, layers, all, rough.small.target, rough.small.map, Accuracy::cached};
  if (all.moving.empty()) return Workspace(setting).solve(all.base, Effort::thorough).cost;
  Options few = options;
  few.trials = std::max<std::uint64_t>(
      1, (options.trials > 0 ? options.trials : default_trials(all.moving.size())) / 4);
  return search(setting, few, watch).front().cost;
}

/// Of the exemplar and its mirror image the one that our lamps can follow, where our sitter is
/// turned.
bool better_mirrored(const studio::Studio& studio, const LayersSource& twin,
                     const ExampleGoal& plain, const ExampleGoal& other, core::Rgb skin,
                     const Options& options, const Variables& all, Watch& watch) {
  const Compared compared(twin, skin);
  const double straight = rough_cost(studio, compared, plain, options, all, watch);
  const double reversed = rough_cost(studio, compared, other, options, all, watch);
  return reversed < kBetterMirrored * straight;
}

}  // namespace

double likely_skin(double lit) {
  const double stops = std::log2(std::max(lit, 1e-3) / (kFacing * kUsualSkin));
  const double of_light =
      kExposureStops * kExposureStops / (kExposureStops * kExposureStops + kSkinStops * kSkinStops);
  return kSkins.clamp(kUsualSkin * std::exp2((1 - of_light) * stops));
}

const Layers& Compared::at(core::Size size) const {
  const Layers& bare = twin_.at(size);
  if (!skin_) return bare;
  const std::lock_guard lock(mutex_);
  auto& entry = sizes_[{size.width, size.height}];
  if (!entry) entry = bare.with_skin(*skin_);
  return entry ? *entry : bare;
}

Match matched(const studio::Studio& studio, const LayersSource& twin, const Goal& goal,
              const Options& options, const Variables& all, Watch& watch) {
  Match match{goal, std::nullopt, false, {}};
  const auto* example = std::get_if<ExampleGoal>(&goal);
  const core::GeometryPlanes* planes = twin.at(options.full_size).geometry();
  if (example == nullptr || (!options.align && !options.normalise)) return match;
  // Painted on our own picture: it lies pixel on pixel.
  if (example->objective == Objective::painted) return match;
  // Its face is not where a sitter's is who looks at the camera: compared as it was drawn.
  if (example->drawn_here && example->sitter_turn != 0) return match;
  const std::optional<OurFace> ours =
      planes != nullptr ? our_face(studio, *planes) : std::optional<OurFace>(OurFace{});
  if (!ours) return match;
  const Alignment alignment = aligned(*example, *ours);
  match.words = alignment.words;
  if (alignment.by == Alignment::By::own_framing) {
    if (options.normalise && !same_skin(studio, kDrawnSkin)) match.skin = kDrawnSkin;
    return match;
  }
  const Window window = options.align ? alignment.window : Window{};
  ExampleGoal laid = laid_on(*example, alignment, ours->box, window, options.normalise);
  if (options.normalise)
    match.skin =
        example->drawn_here ? kDrawnSkin : skin_of(likely_skin(lit_of(laid.exemplar, ours->box)));
  if (options.align && std::abs(ours->turn) > kTurned && alignment.by != Alignment::By::nothing) {
    ExampleGoal other = laid_on(*example, alignment, ours->box,
                                mirrored(window, ours->box, alignment.theirs), options.normalise);
    const bool reversed =
        options.mirrored ? *options.mirrored
                         : better_mirrored(studio, twin, laid, other,
                                           match.skin.value_or(kDrawnSkin), options, all, watch);
    if (reversed) {
      laid = std::move(other);
      match.mirrored = true;
      match.words.push_back(
          "the reference picture's sitter is turned the other way: it is followed "
          "mirrored");
    }
  }
  match.goal = std::move(laid);
  return match;
}

}  // namespace chiaro::design
