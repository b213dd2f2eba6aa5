// SPDX-License-Identifier: Apache-2.0
#include "controller/design/nudge_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "controller/design/variables.h"
#include "controller/design/words.h"
#include "controller/measure/gram.h"
#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

constexpr double kStopsPerStep = 0.25;
// Levels that the picture hardly shows stay in step with the others: this share of what the picture
// itself says about a lamp.
constexpr double kInertia = 1e-3;
// Errors count as they are seen: by dL*/dY, which goes as Y^(-2/3); black is not infinitely dear.
constexpr double kDarkest = 0.004;
// Light and shadow of the subject: these percentiles of its luminance.
constexpr double kShadow = 0.15, kLight = 0.85;
constexpr double kLeastSpread = 0.1;  // stops; a flatter subject has nothing to stretch
constexpr int kSteepenings = 4;
constexpr double kSteepest = 4;     // times what was asked
constexpr double kUnlimited = 256;  // of full: what lamps would give had they no limit
constexpr double kWorthSaying = 1.0 / 24, kMiredWorthSaying = 3;

struct Mixture {
  std::vector<core::Plane> columns;  ///< beside NudgeSetting::free, at level 1
  std::vector<double> levels;
  core::Plane offset;  ///< ambient and what may not change

  core::Plane at(const std::vector<double>& x) const {
    core::Plane sum = offset;
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (std::size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += static_cast<float>(x[k]) * columns[k].values[i];
    return sum;
  }
};

bool is_free(const NudgeSetting& setting, std::size_t fixture) {
  return std::binary_search(setting.free.begin(), setting.free.end(), fixture);
}

core::Plane column(const NudgeSetting& setting, std::size_t fixture, core::FixtureState state) {
  core::Plane plane(setting.layers.size());
  state.set(core::Dof::intensity, 1);
  setting.layers.luminance(fixture, state, Accuracy::cached, plane);
  return plane;
}

Mixture mixture_of(const NudgeSetting& setting, const studio::Rig& rig) {
  Mixture mixture;
  mixture.offset = core::luminance(setting.layers.ambient());
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const double level = rig.states[i].get(core::Dof::intensity);
    if (is_free(setting, i)) {
      mixture.columns.push_back(column(setting, i, rig.states[i]));
      mixture.levels.push_back(level);
    } else if (setting.studio.fixtures[i].controlled && level > 0) {
      const core::Plane lamp = column(setting, i, rig.states[i]);
      for (std::size_t p = 0; p < lamp.values.size(); ++p)
        mixture.offset.values[p] += static_cast<float>(level) * lamp.values[p];
    }
  }
  return mixture;
}

/// The pixels that show the subject; all of them when nothing is known of the geometry.
std::vector<std::size_t> subject_pixels(const Layers& layers) {
  std::vector<std::size_t> pixels;
  const core::GeometryPlanes* geometry = layers.geometry();
  for (std::size_t i = 0; i < layers.size().pixels(); ++i)
    if (geometry == nullptr || geometry->subject.values[i] != 0) pixels.push_back(i);
  if (pixels.empty()) {
    pixels.resize(layers.size().pixels());
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  }
  return pixels;
}

/// Light and shadow of the subject as log2 of luminance, and the mean luminance.
struct Modelling {
  double shadow = 0, light = 0, mean = 0;
  double spread() const { return light - shadow; }
};
Modelling modelling(const core::Plane& picture, const std::vector<std::size_t>& pixels) {
  std::vector<double> values;
  Modelling out;
  for (const std::size_t i : pixels) {
    values.push_back(std::max<double>(picture.values[i], kDarkest));
    out.mean += picture.values[i];
  }
  out.mean /= static_cast<double>(pixels.size());
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  out.shadow = std::log2(values[static_cast<std::size_t>(kShadow * last)]);
  out.light = std::log2(values[static_cast<std::size_t>(kLight * last)]);
  return out;
}

/// Brighter: every pixel by the same stops. More contrast: stops from the subject's mean stretched,
/// so that its light and shadow move apart by what is asked, the background with its lights.
core::Plane wanted_picture(const core::Plane& now, const Modelling& is, const Nudge& nudge) {
  const double gain = std::exp2(kStopsPerStep * nudge.brightness);
  const double spread = std::max(is.spread(), kLeastSpread);
  const double gamma = std::max(0.05, 1 + kStopsPerStep * nudge.contrast / spread);
  const double pivot = std::max(is.mean, kDarkest);
  core::Plane wanted = now;
  for (float& value : wanted.values) {
    const double y = std::max<double>(value, 0);
    const double stretched = nudge.contrast == 0 ? y : pivot * std::pow(y / pivot, gamma);
    value = static_cast<float>(gain * stretched);
  }
  return wanted;
}

std::vector<double> solved(const Mixture& mixture, const core::Plane& wanted,
                           const std::vector<double>& expected,
                           const std::vector<core::Range>& bounds) {
  core::Plane weight = wanted;
  for (float& value : weight.values)
    value = static_cast<float>(std::pow(std::max<double>(value, kDarkest), -4.0 / 3));
  std::vector<const core::Plane*> columns;
  for (const core::Plane& each : mixture.columns) columns.push_back(&each);
  measure::QuadraticForm form =
      measure::least_squares_form(columns, mixture.offset, wanted, &weight);
  for (std::size_t k = 0; k < form.n; ++k) {
    const double hold = kInertia * form.q_matrix[k * form.n + k];
    form.q_matrix[k * form.n + k] += hold;
    form.q_vector[k] += hold * expected[k];
  }
  return optimise::bounded_least_squares(form.q_matrix, form.q_vector, bounds, expected);
}

void limit_by_worst(std::vector<Limit>& limits) {
  std::stable_sort(limits.begin(), limits.end(), [](const Limit& a, const Limit& b) {
    return std::abs(a.missing) > std::abs(b.missing);
  });
}

/// What solving one step needs, whatever its contrast.
struct Step {
  const Mixture& mixture;
  const std::vector<std::size_t>& pixels;
  core::Plane now;
  Modelling is;
  std::vector<core::Range> bounds;
  std::vector<double> expected;  ///< the levels were every lamp to follow the brightness

  std::vector<double> levels(const Nudge& nudge, const std::vector<core::Range>& within) const {
    std::vector<double> start = expected;
    for (std::size_t k = 0; k < start.size(); ++k) start[k] = within[k].clamp(start[k]);
    return solved(mixture, wanted_picture(now, is, nudge), start, within);
  }
  double contrast(const std::vector<double>& x) const {
    return (modelling(mixture.at(x), pixels).spread() - is.spread()) / kStopsPerStep;
  }
};

/// Lamps light more than the tones that are to move, so the curve is steepened until the step is
/// what was asked, as far as the lamps go.
Nudge steepened(const Step& step, const Nudge& nudge, const std::vector<core::Range>& within) {
  Nudge steeper = nudge;
  for (int i = 0; i < kSteepenings && nudge.contrast != 0; ++i) {
    const double missing = nudge.contrast - step.contrast(step.levels(steeper, within));
    if (std::abs(missing) < 0.05) break;
    steeper.contrast = std::clamp(steeper.contrast + missing, -kSteepest * std::abs(nudge.contrast),
                                  kSteepest * std::abs(nudge.contrast));
  }
  return steeper;
}

Step step_from(const NudgeSetting& setting, const Mixture& mixture,
               const std::vector<std::size_t>& pixels, const Nudge& nudge) {
  Step step{mixture, pixels, mixture.at(mixture.levels), {}, {}, mixture.levels};
  step.is = modelling(step.now, pixels);
  for (std::size_t k = 0; k < step.expected.size(); ++k) {
    step.expected[k] *= std::exp2(kStopsPerStep * nudge.brightness);
    step.bounds.push_back({0, setting.studio.fixtures[setting.free[k]].limits.most});
  }
  return step;
}

void solve_levels(const NudgeSetting& setting, const Nudge& asked, NudgedRig& result) {
  const Mixture mixture = mixture_of(setting, result.rig);
  const std::vector<std::size_t> pixels = subject_pixels(setting.layers);
  const Step step = step_from(setting, mixture, pixels, asked);
  const Nudge nudge = steepened(step, asked, step.bounds);
  const std::vector<core::Range> unlimited(step.bounds.size(), {0, kUnlimited});
  const std::vector<double> best = step.levels(nudge, unlimited);
  const std::vector<double> levels = step.levels(nudge, step.bounds);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    result.rig.states[setting.free[k]].set(core::Dof::intensity, levels[k]);
    const double most = step.bounds[k].most;
    if (most <= 0 || levels[k] < 0.999 * most || best[k] <= most) continue;
    const double missing = std::log2(best[k] / most);
    if (missing > kWorthSaying) result.dim.push_back({setting.free[k], missing});
  }
  limit_by_worst(result.dim);
  const Modelling became = modelling(mixture.at(levels), pixels);
  if (step.is.mean > 0 && became.mean > 0)
    result.done.brightness = std::log2(became.mean / step.is.mean) / kStopsPerStep;
  result.done.contrast = step.contrast(levels);
}

double mired(double kelvin) { return 1e6 / kelvin; }

std::optional<core::Range> cct_range(const studio::Fixture& fixture) {
  for (const auto& [dof, range] : fixture.ranges())
    if (dof == core::Dof::cct) return range;
  return std::nullopt;
}

/// Drives whose light has the wanted colour, as near as the emitters come; level takes up what the
/// new mix gives more or less of luminance.
void mix_colour(const studio::Fixture& fixture, core::Rgb wanted, core::Kelvin balance,
                core::FixtureState& state) {
  const auto& primaries = fixture.profile.emitter.primaries;
  const std::size_t n = primaries.size();
  std::vector<core::Rgb> light;
  for (std::size_t p = 0; p < n; ++p) {
    core::FixtureState one = state;
    for (std::size_t q = 0; q < n; ++q) one.set(primaries[q].dof, p == q ? 1 : 0);
    light.push_back(studio::light_colour(fixture, one, balance));
  }
  std::vector<double> matrix(n * n, 0), vector(n, 0), now(n);
  const double level = state.get(core::Dof::intensity);
  const auto channels = [](core::Rgb c) { return std::array<double, 3>{c.r, c.g, c.b}; };
  const std::array<double, 3> to = channels(level * wanted);
  for (std::size_t p = 0; p < n; ++p) {
    now[p] = level * state.get(primaries[p].dof, 1);
    for (std::size_t c = 0; c < 3; ++c) vector[p] += channels(light[p])[c] * to[c];
    for (std::size_t q = 0; q < n; ++q)
      for (std::size_t c = 0; c < 3; ++c)
        matrix[p * n + q] += channels(light[p])[c] * channels(light[q])[c];
  }
  for (std::size_t p = 0; p < n; ++p) {
    const double hold = kInertia * matrix[p * n + p];
    matrix[p * n + p] += hold;
    vector[p] += hold * now[p];
  }
  const std::vector<core::Range> bounds(n, {0, 8});
  const auto drives = optimise::bounded_least_squares(matrix, vector, bounds, now);
  const double most = *std::max_element(drives.begin(), drives.end());
  if (most <= 0) return;
  for (std::size_t p = 0; p < n; ++p) state.set(primaries[p].dof, drives[p] / most);
  state.set(core::Dof::intensity, std::min(most, fixture.limits.most));
}

/// How many mired warmer the lamp's light became.
double shift_colour(const studio::Fixture& fixture, double wanted, core::Kelvin balance,
                    core::FixtureState& state) {
  using Kind = studio::Emitter::Kind;
  if (fixture.profile.emitter.kind == Kind::mixed && !fixture.profile.emitter.primaries.empty()) {
    const core::Rgb shift = core::white_light({1e6 / (mired(balance.value) + wanted)}, 0, balance);
    mix_colour(fixture, shift * studio::light_colour(fixture, state, balance), balance, state);
    return wanted;
  }
  const auto range = cct_range(fixture);
  if (!range) return 0;
  const double now = mired(state.get(core::Dof::cct, fixture.profile.emitter.cct.value));
  const double goes = core::Range{mired(range->most), mired(range->least)}.clamp(now + wanted);
  state.set(core::Dof::cct, 1e6 / goes);
  return goes - now;
}

/// Warmth is shared by every lamp alike, so that they keep their colours beside each other.
void shift_colours(const NudgeSetting& setting, const Nudge& nudge, NudgedRig& result) {
  const double wanted = kNudgeMired * nudge.warmth;
  const core::Kelvin balance = setting.studio.exposure.white_balance;
  const std::vector<std::size_t> pixels = subject_pixels(setting.layers);
  double light = 0, shifted = 0;
  for (std::size_t i = 0; i < result.rig.states.size(); ++i) {
    const studio::Fixture& fixture = setting.studio.fixtures[i];
    core::FixtureState& state = result.rig.states[i];
    const double level = state.get(core::Dof::intensity);
    if (level <= 0 || !fixture.controlled) continue;
    const double gives = level * modelling(column(setting, i, state), pixels).mean;
    light += gives;
    if (!is_free(setting, i)) continue;
    const double went = shift_colour(fixture, wanted, balance, state);
    shifted += gives * went;
    if (std::abs(wanted - went) > kMiredWorthSaying && went * wanted >= 0)
      result.off_colour.push_back({i, wanted - went});
  }
  limit_by_worst(result.off_colour);
  if (light > 0) result.done.warmth = shifted / light / kNudgeMired;
}

/// How wide the lamp looks from the face, degrees.
double width_seen(double width, double height, double distance) {
  return core::degrees(2 * std::atan(std::sqrt(width * height) / 2 / std::max(distance, 0.1)));
}

double width_seen(const studio::Optic& optic, double distance) {
  using Kind = studio::Optic::Kind;
  if (optic.kind == Kind::disk) return width_seen(2 * optic.radius, 2 * optic.radius, distance);
  if (optic.kind == Kind::rectangle) return width_seen(optic.width, optic.height, distance);
  return 0;
}

/// What else the lamp could wear: the nearest step wider, or smaller, than what is fitted now.
const studio::Modifier* other_modifier(const studio::Fixture& fixture, bool softer) {
  const auto area = [&](const studio::Modifier& m) {
    const studio::Optic& bare = fixture.profile.optic;
    return m.width > 0 ? m.width * m.height : bare.width * bare.height;
  };
  const studio::Modifier* best = nullptr;
  for (std::size_t i = 1; i < fixture.modifiers.size(); ++i) {
    const studio::Modifier& other = fixture.modifiers[i];
    const double change = area(other) - area(fixture.modifiers.front());
    if (softer ? change <= 0 : change >= 0) continue;
    if (best == nullptr || std::abs(area(other) - area(*best)) < 1e-9 ||
        std::abs(change) < std::abs(area(*best) - area(fixture.modifiers.front())))
      best = &other;
  }
  return best;
}

std::string modifier_by_hand(const studio::Fixture& fixture, double distance, bool softer) {
  const studio::Modifier* other = other_modifier(fixture, softer);
  if (other == nullptr) return "";
  studio::Fixture fitted = fixture;
  fitted.modifiers = {*other};
  const std::string now = number(width_seen(fixture.fitted_optic(), distance), 0);
  const std::string then = number(width_seen(fitted.fitted_optic(), distance), 0);
  const double loss = other->loss_stops - fixture.modifiers.front().loss_stops;
  const std::string act =
      other->name == "bare" ? "take the " + fixture.modifiers.front().name + " off " + fixture.name
                            : "fit the " + other->name + " to " + fixture.name;
  return act + ": seen from the face it is then " + then + "° wide instead of " + now + "°, with " +
         stops_in_words(loss) + (loss > 0 ? " less light" : " more light");
}

std::string distance_by_hand(const studio::Fixture& fixture, double distance, double steps) {
  const studio::Region* region = region_of(fixture);
  if (region == nullptr) return "";
  const double there = region->distance.clamp(distance * std::exp2(-kStopsPerStep * steps));
  if (std::abs(there - distance) < 0.05) return "";
  return "bring " + fixture.name + (steps > 0 ? " nearer" : " further away") + ", from " +
         number(distance, 2) + " to " + number(there, 2) + " m";
}

}  // namespace

std::string softness_by_hand(const studio::Studio& studio, const studio::Rig& rig, double steps) {
  const bool softer = steps > 0;
  const std::string wish = softer ? "softer: " : "harder: ";
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const studio::Fixture& fixture = studio.fixtures[i];
    if (fixture.role != studio::Role::key) continue;
    const double distance = rig.states[i].get(core::Dof::distance, 2);
    const std::string fit = modifier_by_hand(fixture, distance, softer);
    const std::string move = distance_by_hand(fixture, distance, steps);
    if (!fit.empty() || !move.empty())
      return wish + fit + (fit.empty() || move.empty() ? "" : "; or ") + move;
    return wish + (softer ? "hang a larger diffuser or white cloth before " + fixture.name
                          : "put a smaller source in the place of " + fixture.name);
  }
  return wish + "the studio has no key light whose size could change";
}

NudgedRig nudged_rig(const NudgeSetting& setting, const studio::Rig& rig, const Nudge& nudge) {
  NudgedRig result;
  result.rig = rig;
  if (nudge.brightness != 0 || nudge.contrast != 0) solve_levels(setting, nudge, result);
  if (nudge.warmth != 0) shift_colours(setting, nudge, result);
  return result;
}

}  // namespace chiaro::design
