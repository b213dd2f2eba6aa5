// SPDX-License-Identifier: Apache-2.0
#include "controller/design/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "controller/measure/gram.h"
#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

// The fit looks at 32 x 32 averages: colour of light varies slowly, and subjects differ in detail.
constexpr core::Size kPatches{32, 32};
constexpr double kDarkest = 0.004;  // display-linear; chroma below it is noise
// Pull towards the present colour, relative to a lamp's own weight in the fit: decides only where
// the picture does not.
constexpr double kInertia = 0.002;
constexpr int kColourSteps = 241;

/// One thing a lamp can mix: an end of its CCT range, or one primary.
struct Basis {
  std::size_t fixture = 0;
  core::FixtureState state;
  core::Rgb light;        ///< as the camera sees it at drive 1
  core::Picture columns;  ///< what it adds to the picture at drive 1, in patches
  double start = 0;       ///< its share in the present colour, times the level
};

std::vector<core::FixtureState> ends_of(const studio::Fixture& fixture,
                                        const core::FixtureState& now) {
  std::vector<core::FixtureState> ends;
  const studio::Emitter& emitter = fixture.profile.emitter;
  core::FixtureState state = now;
  state.set(core::Dof::intensity, 1);
  if (emitter.kind == studio::Emitter::Kind::bicolour && emitter.cct_range.width() > 0)
    for (const double cct : {emitter.cct_range.least, emitter.cct_range.most}) {
      state.set(core::Dof::cct, cct);
      ends.push_back(state);
    }
  if (emitter.kind == studio::Emitter::Kind::mixed)
    for (const studio::Primary& primary : emitter.primaries) {
      for (const studio::Primary& other : emitter.primaries) state.set(other.dof, 0);
      state.set(primary.dof, 1);
      ends.push_back(state);
    }
  return ends;
}

void add(core::Picture& sum, double weight, const core::Picture& what) {
  const auto w = static_cast<float>(weight);
  for (std::size_t i = 0; i < sum.red.values.size(); ++i) {
    sum.red.values[i] += w * what.red.values[i];
    sum.green.values[i] += w * what.green.values[i];
    sum.blue.values[i] += w * what.blue.values[i];
  }
}

core::Picture lamp_picture(const Layers& layers, std::size_t fixture,
                           const core::FixtureState& state, Accuracy accuracy) {
  core::Layer layer;
  layers.colour(fixture, state, accuracy, layer);
  add(layer.diffuse, 1, layer.specular);
  return std::move(layer.diffuse);
}

std::vector<Basis> bases_of(const Setting& setting, const studio::Rig& rig) {
  std::vector<Basis> bases;
  for (const std::size_t fixture : setting.variables.lit) {
    const studio::Fixture& lamp = setting.studio.fixtures[fixture];
    const double level = rig.states[fixture].get(core::Dof::intensity);
    if (level <= 0) continue;
    const auto ends = ends_of(lamp, rig.states[fixture]);
    for (const auto& end : ends)
      bases.push_back(
          {fixture, end, studio::light_colour(lamp, end, setting.studio.exposure.white_balance),
           core::resized(lamp_picture(setting.layers, fixture, end, setting.accuracy), kPatches),
           level / static_cast<double>(ends.size())});
  }
  return bases;
}

/// What the mixing lamps do not give: ambient, held lamps and lamps of one colour.
core::Picture the_rest(const Setting& setting, const studio::Rig& rig,
                       const std::vector<Basis>& bases) {
  core::Picture rest = core::resized(setting.layers.ambient(), kPatches);
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const bool mixes = std::any_of(bases.begin(), bases.end(),
                                   [&](const Basis& basis) { return basis.fixture == i; });
    const double level = rig.states[i].get(core::Dof::intensity);
    if (mixes || level <= 0 || !setting.studio.fixtures[i].controlled) continue;
    core::FixtureState state = rig.states[i];
    state.set(core::Dof::intensity, 1);
    add(rest, level,
        core::resized(lamp_picture(setting.layers, i, state, setting.accuracy), kPatches));
  }
  return rest;
}

/// The exemplar's chromaticity at our own luminance, and how much each patch counts.
struct Wanted {
  core::Picture colour{kPatches};
  core::Plane weight{kPatches};
};
Wanted wanted_colour(const Setting& setting, const studio::Rig& rig) {
  Wanted wanted;
  const core::Plane ours = core::luminance(
      core::resized(predicted(setting.studio, setting.layers, rig, setting.accuracy), kPatches));
  const core::Picture theirs = core::resized(setting.target.colour, kPatches);
  for (int y = 0; y < kPatches.height; ++y)
    for (int x = 0; x < kPatches.width; ++x) {
      const core::Rgb c = theirs.at(x, y);
      const double luminance = core::luminance(c), light = ours.at(x, y);
      const bool clipped = std::max({c.r, c.g, c.b}) > 0.95;
      if (luminance < kDarkest || light < kDarkest || clipped) continue;
      wanted.colour.set(x, y, (light / luminance) * c);
      // Errors count as they are seen: by dL*/dY, which goes as Y^(-2/3).
      wanted.weight.at(x, y) = static_cast<float>(std::pow(std::max(light, 0.01), -4.0 / 3));
    }
  return wanted;
}

std::vector<double> solve_drives(const std::vector<Basis>& bases, const core::Picture& rest,
                                 const Wanted& wanted) {
  const std::size_t n = bases.size();
  std::vector<double> matrix(n * n, 0), vector(n, 0);
  for (const auto plane : {&core::Picture::red, &core::Picture::green, &core::Picture::blue}) {
    std::vector<const core::Plane*> columns;
    for (const Basis& basis : bases) columns.push_back(&(basis.columns.*plane));
    const auto form =
        measure::least_squares_form(columns, rest.*plane, wanted.colour.*plane, &wanted.weight);
    for (std::size_t i = 0; i < n * n; ++i) matrix[i] += form.q_matrix[i];
    for (std::size_t i = 0; i < n; ++i) vector[i] += form.q_vector[i];
  }
  std::vector<core::Range> bounds;
  std::vector<double> start;
  for (std::size_t i = 0; i < n; ++i) {
    const double pull = kInertia * matrix[i * n + i];
    matrix[i * n + i] += pull;
    vector[i] += pull * bases[i].start;
    bounds.push_back({0, 8});
    start.push_back(bases[i].start);
  }
  return optimise::bounded_least_squares(matrix, vector, bounds, start);
}

/// How far apart two lights are in colour, whatever their brightness.
double colour_distance(core::Rgb a, core::Rgb b) {
  const double la = core::luminance(a), lb = core::luminance(b);
  if (la <= 0 || lb <= 0) return 10;
  const auto [l, aa, ab] = core::lab_of((0.5 / la) * a);
  const auto [m, ba, bb] = core::lab_of((0.5 / lb) * b);
  return std::hypot(aa - ba, ab - bb);
}

/// The CCT, and the tint where there is one, whose light is nearest to `light`.
core::FixtureState nearest_white(const studio::Fixture& fixture, core::FixtureState state,
                                 core::Rgb light, core::Kelvin balance) {
  const studio::Emitter& emitter = fixture.profile.emitter;
  const int tints = emitter.tint_range.width() > 0 ? 41 : 1;
  core::FixtureState best = state;
  double nearest = 1e9;
  for (int t = 0; t < tints; ++t)
    for (int c = 0; c < kColourSteps; ++c) {
      // Even steps in mired, as the eye sees them.
      const double share = static_cast<double>(c) / (kColourSteps - 1);
      state.set(core::Dof::cct,
                1 / ((1 - share) / emitter.cct_range.least + share / emitter.cct_range.most));
      if (tints > 1)
        state.set(core::Dof::tint,
                  emitter.tint_range.least + emitter.tint_range.width() * t / (tints - 1));
      const double far = colour_distance(studio::light_colour(fixture, state, balance), light);
      if (far >= nearest) continue;
      nearest = far;
      best = state;
    }
  return best;
}

/// Drives with the strongest at full, so that the lamp can still give all the light it has.
core::FixtureState with_drives(const studio::Fixture& fixture, core::FixtureState state,
                               std::span<const double> drives) {
  const double most = *std::max_element(drives.begin(), drives.end());
  if (most <= 0) return state;
  for (std::size_t p = 0; p < drives.size(); ++p)
    state.set(fixture.profile.emitter.primaries[p].dof, drives[p] / most);
  return state;
}

core::FixtureState with_colour(const Setting& setting, const studio::Fixture& fixture,
                               const core::FixtureState& now, std::span<const Basis> bases,
                               std::span<const double> drives) {
  const core::Kelvin balance = setting.studio.exposure.white_balance;
  core::Rgb light;
  for (std::size_t b = 0; b < bases.size(); ++b) light = light + drives[b] * bases[b].light;
  if (core::luminance(light) <= 0) return now;
  core::FixtureState next = fixture.profile.emitter.kind == studio::Emitter::Kind::bicolour
                                ? nearest_white(fixture, now, light, balance)
                                : with_drives(fixture, now, drives);
  const double before = core::luminance(studio::light_colour(fixture, now, balance));
  const double after = core::luminance(studio::light_colour(fixture, next, balance));
  const double level = now.get(core::Dof::intensity) * (after > 0 ? before / after : 1);
  next.set(core::Dof::intensity, std::min(level, fixture.limits.most));
  return next;
}

}  // namespace

core::Picture predicted(const studio::Studio& studio, const Layers& layers, const studio::Rig& rig,
                        Accuracy accuracy) {
  core::Picture picture = layers.ambient();
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const double level = rig.states[i].get(core::Dof::intensity);
    if (level <= 0 || !studio.fixtures[i].controlled) continue;
    core::FixtureState state = rig.states[i];
    state.set(core::Dof::intensity, 1);
    add(picture, level, lamp_picture(layers, i, state, accuracy));
  }
  return picture;
}

studio::Rig with_colours(const Setting& setting, const studio::Rig& rig) {
  if (setting.target.kind == Target::Kind::ideal || !setting.target.coloured) return rig;
  const auto bases = bases_of(setting, rig);
  if (bases.empty()) return rig;
  const auto drives =
      solve_drives(bases, the_rest(setting, rig, bases), wanted_colour(setting, rig));
  studio::Rig coloured = rig;
  for (std::size_t first = 0; first < bases.size();) {
    const std::size_t fixture = bases[first].fixture;
    std::size_t last = first;
    while (last < bases.size() && bases[last].fixture == fixture) ++last;
    coloured.states[fixture] =
        with_colour(setting, setting.studio.fixtures[fixture], rig.states[fixture],
                    std::span(bases).subspan(first, last - first),
                    std::span(drives).subspan(first, last - first));
    first = last;
  }
  return coloured;
}

std::optional<double> better_white_balance(const Target& target, const core::Picture& picture,
                                           core::Kelvin now) {
  if (!target.coloured) return std::nullopt;
  core::Rgb ours, theirs;
  for (int y = 0; y < target.size.height; ++y)
    for (int x = 0; x < target.size.width; ++x) {
      ours = ours + picture.at(x, y);
      theirs = theirs + target.colour.at(x, y);
    }
  double best = now.value, nearest = 1e9;
  for (double kelvin = 2500; kelvin <= 10000; kelvin += 50) {
    const core::Rgb shift = core::white_light(now, 0, core::Kelvin{kelvin});
    const double far = colour_distance(shift * ours, theirs);
    if (far >= nearest) continue;
    nearest = far;
    best = kelvin;
  }
  if (std::abs(best - now.value) <= 150) return std::nullopt;
  return best;
}

}  // namespace chiaro::design
