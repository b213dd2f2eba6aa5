// SPDX-License-Identifier: Apache-2.0
// The scenes that the studies light, and the reality that is photographed there: a world that is a
// little different from what the twin believes, drawn by the path tracer, never by the twin.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/random.h"
#include "controller/core/result.h"
#include "controller/design/design.h"
#include "controller/ports/world.h"
#include "controller/render/view.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon::study {

/// "bust": the shipped sitter; "still life": box, ball and ring on a table; "vase": a vase beside a
/// knot. Before a wall, seen as a portrait is.
std::span<const std::string_view> scene_names();

/// Lamps that stand in the quarter sphere in front and above, 1.2 to 2.4 m away: key, fill, then
/// kickers, all alike.
struct Lamps {
  int count = 2;
  studio::Optic optic;  ///< a point unless said otherwise
  double candela = 4000;
};
/// Meshes are written to the world's state folder when first wanted.
core::Result<studio::Studio> scene(std::string_view name, const Lamps& lamps, ports::World& world);

/// How far the twin is from what is really there.
struct Errors {
  double albedo = 0.10;               ///< each material and channel, uniform within +-
  double normals = core::radians(5);  ///< root mean square, varying smoothly over the subject
  int bounces = 5;                    ///< of light between surfaces; the twin has them coarsely
  bool noise = true;                  ///< of the sensor
};
inline constexpr Errors kNoErrors{0, 0, 5, false};

struct Reality {
  std::shared_ptr<const render::Tracer> tracer;
  Errors errors;
};
Reality reality(const studio::Studio& studio, const Errors& errors, core::Random& random,
                ports::World& world);

/// How pictures are taken.
struct Shot {
  core::Size size{256, 256};
  int samples = 24;  ///< light paths per pixel
  std::uint64_t seed = 1;
  int threads = 2;
};
/// What the camera delivers: clipped, with the sensor's noise, in 8 bits; as linear light again.
core::Picture photograph(const studio::Studio& studio, const Reality& real, const studio::Rig& rig,
                         const Shot& shot);

/// A rig with every lamp somewhere that it may stand, at least `apart` radians from each other as
/// seen from the aim, the first giving 500 to 900 lx at the aim, the others 0 to `most_stops` less.
studio::Rig hidden_rig(const studio::Studio& studio, const twin::Geometry& geometry, double apart,
                       double most_stops, core::Random& random);

/// Unit direction from the aim to a lamp, and its light there, lux, facing it.
core::Vec3 direction_of(const core::FixtureState& state);
double lux_of(const studio::Fixture& fixture, const core::FixtureState& state);

/// The twin that designs use, with the world's mesh cache. `bounced` false: it knows the lamps' own
/// light alone.
core::Result<std::unique_ptr<design::LayersSource>> twin_of(const studio::Studio& studio,
                                                            ports::World& world, int threads,
                                                            bool bounced = true);
/// Options as the thesis lights: the exemplar as it is, neither aligned nor normalised.
design::Options plain_options(std::uint64_t seed, int threads, ports::World& world);

}  // namespace chiaro::daemon::study
