// SPDX-License-Identifier: Apache-2.0
#include "controller/design/beyond.h"

#include <algorithm>
#include <cmath>

#include "controller/core/colour.h"

namespace chiaro::design {
namespace {

// Mean luminance of a frame taken with the cap on: a few steps of an 8-bit file at most.
constexpr double kBlack = 0.0015;
// Distance from grey in CIELAB at L* 76. Tungsten light on skin under daylight balance stays below.
constexpr double kStrong = 75;
constexpr double kReached = 0.25, kNear = 0.4;
// Pixels: an eye's worth. With fewer there is no shape to tell light by.
constexpr std::size_t kFewest = 64;

struct Chroma {
  double a = 0, b = 0;
  double strength() const { return std::hypot(a, b); }
};

/// Of the picture's mean colour, brightness apart.
Chroma mean_chroma(const core::Picture& picture) {
  core::Rgb sum;
  for (std::size_t i = 0; i < picture.red.values.size(); ++i)
    sum = sum + core::Rgb{picture.red.values[i], picture.green.values[i], picture.blue.values[i]};
  const double luminance = core::luminance(sum);
  if (!(luminance > 0)) return {};
  const auto lab = core::lab_of((0.5 / luminance) * sum);
  return {lab.a, lab.b};
}

/// The hue's name, and the gel that a shop sells for it.
const char* name_of(Chroma chroma) {
  struct Hue {
    double from;  ///< degrees of the CIELAB hue angle
    const char* name;
  };
  static constexpr Hue kHues[] = {{20, "red"},   {55, "orange"}, {80, "yellow"},  {115, "green"},
                                  {180, "cyan"}, {240, "blue"},  {310, "magenta"}};
  const double turn = core::degrees(std::atan2(chroma.b, chroma.a));
  const double angle = turn < 0 ? turn + 360 : turn;
  const char* name = "magenta";
  for (const Hue& hue : kHues)
    if (angle >= hue.from) name = hue.name;
  return name;
}

}  // namespace

std::string black_in_words(const Target& target) {
  if (target.luminance.values.empty()) return "";
  double sum = 0;
  for (const float value : target.luminance.values) sum += static_cast<double>(value);
  if (sum > kBlack * static_cast<double>(target.luminance.values.size())) return "";
  return "the reference picture is black: nothing is nearer to it than every lamp dark; choose one "
         "that shows some light";
}

double colour_missing(const Target& target, const core::Picture& picture) {
  if (!target.coloured || target.colour.red.empty()) return 0;
  const Chroma theirs = mean_chroma(target.colour);
  if (theirs.strength() < kStrong) return 0;
  const Chroma ours = mean_chroma(picture);
  return std::hypot(ours.a - theirs.a, ours.b - theirs.b) / theirs.strength();
}

void judge_colour(const Target& target, const core::Picture& picture, Judgement& judgement) {
  const double missing = colour_missing(target, picture);
  if (missing <= kReached) return;
  const Verdict verdict = missing <= kNear ? Verdict::near : Verdict::not_reachable;
  judgement.verdict = std::max(judgement.verdict, verdict);
  judgement.residual = std::max(judgement.residual, missing);
  const std::string hue = name_of(mean_chroma(target.colour));
  judgement.remedy = "the reference is far more " + hue + " than these lamps make it: fit a " +
                     hue + " gel, or use lamps that mix colours" +
                     (judgement.remedy.empty() ? "" : "; " + judgement.remedy);
}

std::string unseen_in_words(const studio::Studio& studio, const Layers& layers) {
  const core::GeometryPlanes* planes = layers.geometry();
  if (planes == nullptr || studio.subjects.empty()) return "";
  const auto& shown = planes->subject.values;
  const auto seen = static_cast<std::size_t>(
      std::count_if(shown.begin(), shown.end(), [](std::uint8_t v) { return v != 0; }));
  const std::string& camera = studio.main_camera().name;
  if (seen == 0)
    return "camera " + camera +
           " sees nothing of the subject: the light on it cannot be judged; point the camera at "
           "it, "
           "or correct where the subject stands";
  if (seen >= kFewest) return "";
  return "camera " + camera + " sees the subject in " + std::to_string(seen) + " of " +
         std::to_string(shown.size()) +
         " points: too few to judge its light; bring the camera nearer, or zoom in";
}

void judge_locked(const Variables& variables, Judgement& judgement) {
  if (!variables.lit.empty() || judgement.verdict == Verdict::reached) return;
  judgement.remedy = variables.held.empty() ? "the studio has no lamp: add one"
                                            : "every lamp is locked: unlock one";
}

}  // namespace chiaro::design
