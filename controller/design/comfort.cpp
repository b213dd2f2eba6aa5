// SPDX-License-Identifier: Apache-2.0
#include "controller/design/comfort.h"

#include <algorithm>
#include <cmath>

#include "controller/design/starts.h"
#include "controller/design/variables.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

using core::Vec3;

constexpr double kHalfApart = 0.0315, kBeforeHead = 0.075, kGlassBeforeEye = 0.012;
const double kLean = core::radians(8), kIris = core::radians(35);
constexpr double kLit = 0.0005;
// From here on a person notices: burnt skin and background, a background brighter than the face, a
// shadow's size and depth.
constexpr double kBurnt = 0.01, kBurntWall = 0.05, kOutshines = 1, kShadow = 0.03,
                 kShadowStops = 1.0 / 3;
constexpr double kHidden = 0.5;  // of the lamp, from where on a pixel lies in its shadow

bool is_lit(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture) {
  return studio.fixtures[fixture].controlled &&
         rig.states[fixture].get(core::Dof::intensity) > kLit;
}

double radius_of(const studio::Fixture& fixture) {
  const studio::Optic optic = fixture.fitted_optic();
  if (optic.kind == studio::Optic::Kind::rectangle) return std::max(optic.width, optic.height) / 2;
  return optic.kind == studio::Optic::Kind::disk ? optic.radius : 0.05;
}

Vec3 place_of(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture) {
  return twin::pose(studio.fixtures[fixture], rig.states[fixture], estimated_aim(studio)).position;
}

bool glares(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture) {
  const Vec3 lamp = place_of(studio, rig, fixture), camera = studio.main_camera().at;
  const double radius = radius_of(studio.fixtures[fixture]);
  for (const Lens& lens : glasses_on(eyes_of(studio)))
    if (shows_in(lens, lamp, radius, camera)) return true;
  return false;
}

/// Light of the subject's and the background's pixels.
struct Sides {
  double subject = 0, background = 0;
  std::size_t subjects = 0, backgrounds = 0, burnt = 0, burnt_background = 0;
};
Sides sides_of(const core::GeometryPlanes& planes, const core::Picture& picture) {
  Sides sides;
  const core::Plane light = core::luminance(picture);
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    const bool white =
        std::max({picture.red.values[i], picture.green.values[i], picture.blue.values[i]}) >= 1;
    const double y = std::min(1.0, double{light.values[i]});
    if (planes.subject.values[i]) {
      sides.subject += y;
      ++sides.subjects;
      sides.burnt += white;
    } else if (planes.object.values[i] != core::kNothing) {
      sides.background += y;
      ++sides.backgrounds;
      sides.burnt_background += white;
    }
  }
  return sides;
}

/// What the lamp's shadow takes from the background: its light where it falls there, against all.
Comfort::Shadow shadow_of(const Layers& layers, const studio::Rig& rig, std::size_t fixture,
                          const core::Plane& light) {
  const core::GeometryPlanes& planes = *layers.geometry();
  core::FixtureState full = rig.states[fixture];
  full.set(core::Dof::intensity, 1);
  core::Plane seen(layers.size()), lamp(layers.size());
  layers.visibility(fixture, full, Accuracy::exact, seen);
  layers.luminance(fixture, full, Accuracy::exact, lamp);
  double hidden = 0, dark = 0, open = 0, given = 0, all = 0;
  for (std::size_t i = 0; i < seen.values.size(); ++i) {
    if (planes.subject.values[i] || planes.object.values[i] == core::kNothing) continue;
    ++all;
    if (seen.values[i] < kHidden) {
      ++hidden;
      dark += double{light.values[i]};
    } else if (lamp.values[i] > 0) {
      ++open;
      given += double{lamp.values[i]};
    }
  }
  Comfort::Shadow shadow{fixture, all > 0 ? hidden / all : 0, 0};
  if (hidden == 0 || open == 0 || dark <= 0) return shadow;
  const double missing = rig.states[fixture].get(core::Dof::intensity) * given / open;
  shadow.stops = std::log2(1 + missing * hidden / dark);
  return shadow;
}

/// The least rise of a stand, in steps of 5 degrees, at which it no longer shows in glasses.
std::string without_glare(const studio::Studio& studio, studio::Rig rig, std::size_t fixture) {
  const studio::Region* region = region_of(studio.fixtures[fixture]);
  if (region == nullptr) return "turn the glasses' temples up a little, or ask for a lower chin";
  core::FixtureState& state = rig.states[fixture];
  for (const core::Dof dof : {core::Dof::elevation, core::Dof::azimuth})
    for (int step = 1; step <= 8; ++step) {
      const double was = state.get(dof);
      const double away = dof == core::Dof::azimuth && was < 0 ? -1 : 1;
      const double to = was + away * core::radians(5.0 * step);
      const core::Range range = dof == core::Dof::elevation ? region->elevation : region->azimuth;
      state.set(dof, to);
      const bool good = range.contains(to) && !glares(studio, rig, fixture);
      state.set(dof, was);
      if (!good) continue;
      return dof == core::Dof::elevation ? "raise it to " + core::elevation_in_words(to)
                                         : "take it round to " + core::azimuth_in_words(to);
    }
  return "turn the glasses' temples up a little, or ask for a lower chin";
}

std::string thrown(const studio::Fixture& fixture, const Comfort::Shadow& shadow) {
  return fixture.name + " throws the subject's shadow on the background (" +
         stops_in_words(shadow.stops) + " darker): move the subject further from it, raise " +
         fixture.name + ", or light the background by itself";
}

}  // namespace

Eyes eyes_of(const studio::Studio& studio) {
  const core::AimFrame aim = estimated_aim(studio);
  const double facing = studio.subjects.empty() ? 0 : studio.subjects.front().facing;
  Eyes eyes;
  eyes.gaze = std::cos(facing) * aim.towards_camera + std::sin(facing) * aim.camera_right;
  // The sitter's right is on the camera's left.
  const Vec3 to_left = core::cross(Vec3{0, 0, 1}, eyes.gaze);
  const Vec3 middle = aim.origin + kBeforeHead * eyes.gaze;
  eyes.left = middle + kHalfApart * to_left;
  eyes.right = middle - kHalfApart * to_left;
  return eyes;
}

std::array<Lens, 2> glasses_on(const Eyes& eyes) {
  const Vec3 normal = std::cos(kLean) * eyes.gaze + std::sin(-kLean) * Vec3{0, 0, 1};
  Lens lens;
  lens.normal = core::unit(normal);
  std::array<Lens, 2> both{lens, lens};
  both[0].centre = eyes.right + kGlassBeforeEye * eyes.gaze;
  both[1].centre = eyes.left + kGlassBeforeEye * eyes.gaze;
  return both;
}

bool shows_in(const Lens& lens, Vec3 lamp, double lamp_radius, Vec3 camera) {
  const double before = core::dot(lamp - lens.centre, lens.normal);
  const double eye = core::dot(camera - lens.centre, lens.normal);
  if (before <= 0 || eye <= 0) return false;
  const Vec3 image = lamp - (2 * before) * lens.normal;
  // From the camera to the image: where it passes through the glass, and how large the lamp is
  // there.
  const double share = eye / (eye + before);
  const Vec3 at = camera + share * (image - camera) - lens.centre;
  const Vec3 across = core::unit(core::cross(Vec3{0, 0, 1}, lens.normal));
  const Vec3 up = core::cross(lens.normal, across);
  const double grown = share * lamp_radius;
  const double x = core::dot(at, across) / (lens.half_width + grown),
               y = core::dot(at, up) / (lens.half_height + grown);
  return x * x + y * y <= 1;
}

bool catches(Vec3 eye, Vec3 gaze, Vec3 lamp, Vec3 camera) {
  const Vec3 half = core::unit(lamp - eye) + core::unit(camera - eye);
  if (core::length(half) < 1e-9) return false;
  return core::angle_between(half, gaze) <= kIris;
}

Comfort comfort_of(const studio::Studio& studio, const Layers& layers, const studio::Rig& rig,
                   const core::Picture& picture) {
  Comfort comfort;
  const core::GeometryPlanes* planes = layers.geometry();
  if (studio.subjects.empty() || planes == nullptr) return comfort;
  const Eyes eyes = eyes_of(studio);
  const Vec3 camera = studio.main_camera().at;
  const core::Plane light = core::luminance(picture);
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    if (!is_lit(studio, rig, i)) continue;
    const Vec3 lamp = place_of(studio, rig, i);
    comfort.right_eye |= catches(eyes.right, eyes.gaze, lamp, camera);
    comfort.left_eye |= catches(eyes.left, eyes.gaze, lamp, camera);
    if (glares(studio, rig, i)) comfort.glare.push_back(i);
    const Comfort::Shadow shadow = shadow_of(layers, rig, i, light);
    if (shadow.share >= kShadow && shadow.stops >= kShadowStops) comfort.shadows.push_back(shadow);
  }
  const Sides sides = sides_of(*planes, picture);
  const auto share = [](std::size_t part, std::size_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0;
  };
  comfort.burnt_skin = share(sides.burnt, sides.subjects);
  comfort.burnt_background = share(sides.burnt_background, sides.backgrounds);
  if (sides.subject > 0 && sides.background > 0)
    comfort.background_over_face =
        std::log2(sides.background / static_cast<double>(sides.backgrounds) /
                  (sides.subject / static_cast<double>(sides.subjects)));
  return comfort;
}

std::vector<std::string> comfort_in_words(const studio::Studio& studio, const studio::Rig& rig,
                                          const Comfort& comfort, bool glasses) {
  std::vector<std::string> words;
  if (glasses)
    for (const std::size_t i : comfort.glare)
      words.push_back(studio.fixtures[i].name +
                      " shows in the glasses: " + without_glare(studio, rig, i));
  bool any_lit = false;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) any_lit |= is_lit(studio, rig, i);
  if (any_lit && !studio.subjects.empty() && !(comfort.right_eye && comfort.left_eye))
    words.push_back(
        std::string(comfort.right_eye || comfort.left_eye ? "one eye has" : "the eyes have") +
        " no catch-light: bring a lamp nearer to the camera's side, or hold a small white card "
        "below the lens");
  if (comfort.burnt_skin > kBurnt)
    words.push_back(number(100 * comfort.burnt_skin, 0) +
                    " % of the subject is burnt out: close the aperture ⅓ stop, or take the "
                    "brightest lamp down");
  if (comfort.burnt_background > kBurntWall)
    words.push_back(number(100 * comfort.burnt_background, 0) +
                    " % of the background is burnt out: take its light down, or move it away");
  else if (comfort.background_over_face > kOutshines)
    words.push_back("the background is " + stops_in_words(comfort.background_over_face) +
                    " brighter than the subject: take its light down, or use a darker one");
  for (const Comfort::Shadow& shadow : comfort.shadows)
    words.push_back(thrown(studio.fixtures[shadow.fixture], shadow));
  return words;
}

double glare_share(const studio::Studio& studio, const studio::Rig& rig) {
  double all = 0, shown = 0;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    if (!is_lit(studio, rig, i)) continue;
    const double light = lux_at_face(studio, rig, i);
    all += light;
    if (glares(studio, rig, i)) shown += light;
  }
  return all > 0 ? shown / all : 0;
}

}  // namespace chiaro::design
