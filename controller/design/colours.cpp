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
constexpr double kSaturated = 0.1;  // its weakest channel is below
// Gauss-Newton on CCT, tint and drives; each step is held back by this share of the strongest
// lamp's weight, so that a lamp which hardly shows keeps its colour.
constexpr int kSteps = 8;
constexpr double kInertia = 1e-3;
// Tint is a correction: it moves only where CCT alone leaves something to do.
constexpr double kTintInertia = 20;
constexpr double kMiredStep = 2, kTintStep = 1;

double mired(double kelvin) { return 1e6 / kelvin; }

/// One lamp that can mix colours. `neutral` is what it adds to the picture under light of (1, 1,
/// 1).
struct Mixer {
  std::size_t fixture = 0;
  core::FixtureState state;
  double light_kept = 0;  ///< luminance of its light, level included
  core::Picture neutral;
  std::vector<double> values;  ///< bicolour: mired, tint; mixed: level x drive of each primary
  std::vector<core::Range> ranges;
  std::vector<double> inertia;
};

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
      // Saturated light tells its colour even where its strongest channel is at its end.
      const bool clipped =
          std::max({c.r, c.g, c.b}) > 0.95 && std::min({c.r, c.g, c.b}) > kSaturated;
      if (luminance < kDarkest || light < kDarkest || clipped) continue;
      wanted.colour.set(x, y, (light / luminance) * c);
      // Errors count as they are seen: by dL*/dY, which goes as Y^(-2/3).
      wanted.weight.at(x, y) = static_cast<float>(std::pow(std::max(light, 0.01), -4.0 / 3));
    }
  if (setting.target.emphasis.empty()) return wanted;
  const core::Plane emphasis = core::resized(setting.target.emphasis, kPatches);
  for (std::size_t i = 0; i < emphasis.values.size(); ++i)
    wanted.weight.values[i] *= emphasis.values[i];
  return wanted;
}

/// How far apart two lights are in colour, whatever their brightness.
double colour_distance(core::Rgb a, core::Rgb b) {
  const double la = core::luminance(a), lb = core::luminance(b);
  if (la <= 0 || lb <= 0) return 10;
  const auto [l, aa, ab] = core::lab_of((0.5 / la) * a);
  const auto [m, ba, bb] = core::lab_of((0.5 / lb) * b);
  return std::hypot(aa - ba, ab - bb);
}

bool mixes(const studio::Emitter& emitter) {
  return emitter.kind == studio::Emitter::Kind::mixed ||
         (emitter.has_white_mix() && emitter.cct_range.width() > 0);
}

core::FixtureState with_values(const studio::Fixture& fixture, core::FixtureState state,
                               std::span<const double> values) {
  const studio::Emitter& emitter = fixture.profile.emitter;
  if (emitter.has_white_mix()) {
    state.set(core::Dof::cct, mired(values[0]));
    if (values.size() > 1) state.set(core::Dof::tint, values[1]);
    return state;
  }
  // The strongest drive at full, so that the lamp can still give all the light it has.
  const double most = *std::max_element(values.begin(), values.end());
  if (most <= 0) return state;
  for (std::size_t p = 0; p < values.size(); ++p)
    state.set(emitter.primaries[p].dof, values[p] / most);
  return state;
}

/// The lamp's light, level included. A bicolour lamp keeps its luminance whatever its CCT.
core::Rgb light_of(const Setting& setting, const Mixer& mixer, std::span<const double> values) {
  const studio::Fixture& fixture = setting.studio.fixtures[mixer.fixture];
  const core::Rgb light = studio::light_colour(fixture, with_values(fixture, mixer.state, values),
                                               setting.studio.exposure.white_balance);
  if (fixture.profile.emitter.kind == studio::Emitter::Kind::mixed)
    return *std::max_element(values.begin(), values.end()) * light;
  const double luminance = core::luminance(light);
  return luminance > 0 ? (mixer.light_kept / luminance) * light : light;
}

core::Picture tinted(const core::Picture& neutral, core::Rgb light) {
  core::Picture result(neutral.size());
  for (std::size_t i = 0; i < result.red.values.size(); ++i) {
    result.red.values[i] = static_cast<float>(light.r) * neutral.red.values[i];
    result.green.values[i] = static_cast<float>(light.g) * neutral.green.values[i];
    result.blue.values[i] = static_cast<float>(light.b) * neutral.blue.values[i];
  }
  return result;
}

core::Picture patches_of(const Setting& setting, std::size_t fixture, core::FixtureState state) {
  state.set(core::Dof::intensity, 1);
  return core::resized(lamp_picture(setting.layers, fixture, state, setting.accuracy), kPatches);
}

/// A colour in which every channel shows, so that dividing by it is safe.
core::FixtureState white_state(const studio::Fixture& fixture, core::FixtureState state) {
  for (const studio::Primary& primary : fixture.profile.emitter.primaries)
    state.set(primary.dof, 1);
  return state;
}

/// As far as the lamp's mode and hands reach: a tint without a channel would show in the preview
/// and never on the wire.
core::Range tint_range(const studio::Fixture& fixture) {
  for (const auto& [dof, range] : fixture.ranges())
    if (dof == core::Dof::tint) return range;
  return {};
}

void add_bicolour_values(const studio::Fixture& fixture, Mixer& mixer) {
  const studio::Emitter& emitter = fixture.profile.emitter;
  const core::Range range{mired(emitter.cct_range.most), mired(emitter.cct_range.least)};
  mixer.values = {range.clamp(mired(mixer.state.get(core::Dof::cct, emitter.cct.value)))};
  mixer.ranges = {range};
  mixer.inertia = {1};
  const core::Range tint = tint_range(fixture);
  if (tint.width() <= 0) return;
  mixer.values.push_back(tint.clamp(mixer.state.get(core::Dof::tint)));
  mixer.ranges.push_back(tint);
  mixer.inertia.push_back(kTintInertia);
}

void add_mixed_values(const studio::Emitter& emitter, double level, Mixer& mixer) {
  for (const studio::Primary& primary : emitter.primaries) {
    mixer.values.push_back(level * mixer.state.get(primary.dof, 1));
    mixer.ranges.push_back({0, 8});
    mixer.inertia.push_back(1);
  }
}

std::vector<Mixer> mixers_of(const Setting& setting, const studio::Rig& rig) {
  std::vector<Mixer> mixers;
  const core::Kelvin balance = setting.studio.exposure.white_balance;
  for (const std::size_t fixture : setting.variables.lit) {
    const studio::Fixture& lamp = setting.studio.fixtures[fixture];
    const double level = rig.states[fixture].get(core::Dof::intensity);
    if (level <= 0 || !mixes(lamp.profile.emitter)) continue;
    Mixer mixer{fixture, rig.states[fixture], 0, {}, {}, {}, {}};
    mixer.light_kept = level * core::luminance(studio::light_colour(lamp, mixer.state, balance));
    const core::FixtureState white = white_state(lamp, mixer.state);
    const core::Rgb light = studio::light_colour(lamp, white, balance);
    const auto inverse = [](double channel) { return channel > 1e-6 ? 1 / channel : 0; };
    mixer.neutral = tinted(patches_of(setting, fixture, white),
                           {inverse(light.r), inverse(light.g), inverse(light.b)});
    if (lamp.profile.emitter.has_white_mix())
      add_bicolour_values(lamp, mixer);
    else
      add_mixed_values(lamp.profile.emitter, level, mixer);
    mixers.push_back(std::move(mixer));
  }
  return mixers;
}

/// What the mixing lamps do not give: ambient, held lamps and lamps of one colour.
core::Picture the_rest(const Setting& setting, const studio::Rig& rig,
                       const std::vector<Mixer>& mixers) {
  core::Picture rest = core::resized(setting.layers.ambient(), kPatches);
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const bool mixing = std::any_of(mixers.begin(), mixers.end(),
                                    [&](const Mixer& mixer) { return mixer.fixture == i; });
    const double level = rig.states[i].get(core::Dof::intensity);
    if (mixing || level <= 0 || !setting.studio.fixtures[i].controlled) continue;
    add(rest, level, patches_of(setting, i, rig.states[i]));
  }
  return rest;
}

/// How the picture changes with one value of one lamp, by central difference.
core::Picture slope(const Setting& setting, const Mixer& mixer, std::size_t value) {
  const bool bicolour = setting.studio.fixtures[mixer.fixture].profile.emitter.has_white_mix();
  const double step = !bicolour ? 1e-3 : value == 0 ? kMiredStep : kTintStep;
  std::vector<double> values = mixer.values;
  values[value] = mixer.ranges[value].clamp(mixer.values[value] + step);
  const double above = values[value];
  const core::Rgb up = light_of(setting, mixer, values);
  values[value] = mixer.ranges[value].clamp(mixer.values[value] - step);
  const core::Rgb down = light_of(setting, mixer, values);
  return tinted(mixer.neutral, (1 / (above - values[value])) * (up + -1.0 * down));
}

/// One Gauss-Newton step of every lamp's values towards the wanted chroma.
void step(const Setting& setting, const core::Picture& rest, const Wanted& wanted,
          std::vector<Mixer>& mixers) {
  core::Picture now = rest;
  std::vector<core::Picture> slopes;
  std::vector<core::Range> bounds;
  std::vector<double> inertia;
  for (const Mixer& mixer : mixers) {
    add(now, 1, tinted(mixer.neutral, light_of(setting, mixer, mixer.values)));
    for (std::size_t v = 0; v < mixer.values.size(); ++v) {
      slopes.push_back(slope(setting, mixer, v));
      bounds.push_back(
          {mixer.ranges[v].least - mixer.values[v], mixer.ranges[v].most - mixer.values[v]});
      inertia.push_back(mixer.inertia[v]);
    }
  }
  const std::size_t n = slopes.size();
  std::vector<double> matrix(n * n, 0), vector(n, 0);
  for (const auto plane : {&core::Picture::red, &core::Picture::green, &core::Picture::blue}) {
    std::vector<const core::Plane*> columns;
    for (const core::Picture& each : slopes) columns.push_back(&(each.*plane));
    const auto form =
        measure::least_squares_form(columns, now.*plane, wanted.colour.*plane, &wanted.weight);
    for (std::size_t i = 0; i < n * n; ++i) matrix[i] += form.q_matrix[i];
    for (std::size_t i = 0; i < n; ++i) vector[i] += form.q_vector[i];
  }
  // Values differ in unit: weights are compared over each value's whole range.
  double strongest = 0;
  const auto width = [&](std::size_t i) { return bounds[i].most - bounds[i].least; };
  for (std::size_t i = 0; i < n; ++i)
    strongest = std::max(strongest, matrix[i * n + i] * width(i) * width(i));
  for (std::size_t i = 0; i < n; ++i)
    matrix[i * n + i] += kInertia * inertia[i] * strongest / (width(i) * width(i));
  const auto change = optimise::bounded_least_squares(matrix, vector, bounds);
  std::size_t i = 0;
  for (Mixer& mixer : mixers)
    for (std::size_t v = 0; v < mixer.values.size(); ++v)
      mixer.values[v] = mixer.ranges[v].clamp(mixer.values[v] + change[i++]);
}

core::FixtureState coloured(const Setting& setting, const Mixer& mixer) {
  const studio::Fixture& fixture = setting.studio.fixtures[mixer.fixture];
  core::FixtureState state = with_values(fixture, mixer.state, mixer.values);
  const double light =
      core::luminance(studio::light_colour(fixture, state, setting.studio.exposure.white_balance));
  if (light <= 0) return mixer.state;
  state.set(core::Dof::intensity, std::min(mixer.light_kept / light, fixture.limits.most));
  return state;
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
  std::vector<Mixer> mixers = mixers_of(setting, rig);
  if (mixers.empty()) return rig;
  const core::Picture rest = the_rest(setting, rig, mixers);
  const Wanted wanted = wanted_colour(setting, rig);
  // Nowhere can its colour be told: no reason to change any lamp's.
  if (std::all_of(wanted.weight.values.begin(), wanted.weight.values.end(),
                  [](float weight) { return weight <= 0; }))
    return rig;
  for (int i = 0; i < kSteps; ++i) step(setting, rest, wanted, mixers);
  studio::Rig result = rig;
  for (const Mixer& mixer : mixers) result.states[mixer.fixture] = coloured(setting, mixer);
  return result;
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
