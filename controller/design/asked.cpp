// SPDX-License-Identifier: Apache-2.0
#include "controller/design/asked.h"

#include <algorithm>
#include <cmath>

#include "controller/design/colours.h"
#include "controller/design/starts.h"
#include "controller/design/words.h"
#include "controller/twin/scene.h"

namespace chiaro::design {
namespace {

using core::Vec3;

/// What a pixel of the square view shows: the surface's place and normal, as its planes have them.
struct Surface {
  Vec3 at, normal, viewer;
};
Surface surface_at(const studio::Camera& camera, const core::GeometryPlanes& planes, int x, int y) {
  const Vec3 axis = core::unit(camera.look_at - camera.at);
  const Vec3 level = core::cross(axis, Vec3{0, 0, 1});
  const Vec3 right = core::length(level) > 1e-9 ? core::unit(level) : Vec3{1, 0, 0};
  const double reach = std::tan(camera.vertical_fov / 2);
  const core::Size size = planes.depth.size;
  const double a = 2 * (x + 0.5) / size.width - 1, b = 1 - 2 * (y + 0.5) / size.height;
  const Vec3 along = axis + (a * reach) * right + (b * reach) * core::cross(right, axis);
  Surface s;
  s.at = camera.at + static_cast<double>(planes.depth.at(x, y)) * along;
  s.normal = {planes.normal_x.at(x, y), planes.normal_y.at(x, y), planes.normal_z.at(x, y)};
  s.viewer = core::unit(camera.at - s.at);
  return s;
}

/// The light must come from where the eye's ray is mirrored to; nothing where nothing is seen.
Asked::Mirror mirror_of(const Wish& wish, const studio::Studio& studio,
                        const core::GeometryPlanes& planes) {
  const core::Size size = planes.depth.size;
  const auto [u, v] = in_square(studio.main_camera(), wish.region.x, wish.region.y);
  const int x = std::clamp(static_cast<int>(u * size.width), 0, size.width - 1);
  const int y = std::clamp(static_cast<int>(v * size.height), 0, size.height - 1);
  if (planes.object.at(x, y) == core::kNothing) return {};
  const Surface s = surface_at(studio.main_camera(), planes, x, y);
  return {s.at, (2 * core::dot(s.normal, s.viewer)) * s.normal - s.viewer};
}

struct Moments {
  double mean = 0, spread = 0;
};
/// Of L*, over a mask whose sum is 1.
Moments lightness_over(const core::Plane& mask, const core::Plane& luminance) {
  double first = 0, second = 0;
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    if (mask.values[i] <= 0) continue;
    const double l = core::lightness(std::min(1.0, double{luminance.values[i]}));
    first += double{mask.values[i]} * l;
    second += double{mask.values[i]} * l * l;
  }
  return {first, std::sqrt(std::max(0.0, second - first * first))};
}

bool about_shadow(const Wish& wish) {
  return wish.kind == Wish::Kind::no_shadow || wish.kind == Wish::Kind::shadow;
}

/// 0..1 from what was measured of a wish about places.
double cost_of_place(const Wish& wish, double measured) {
  if (wish.kind == Wish::Kind::no_shadow) return measured;
  if (wish.kind == Wish::Kind::shadow) return 1 - measured;
  return std::min(1.0, measured / (core::kPi / 2));
}

bool about_place(const Wish& wish) {
  return about_shadow(wish) || wish.kind == Wish::Kind::highlight;
}

void add_shape(const Layers& layers, const Goal& goal, Asked& asked) {
  if (asked.wishes->terms.empty()) return;
  const core::GeometryPlanes* planes = layers.geometry();
  asked.map =
      planes != nullptr ? measure::pixel_map(*planes) : measure::flat_pixel_map(layers.size());
  if (planes != nullptr) asked.curvature = measure::terms::curvature_of(*planes);
  const auto* example = std::get_if<ExampleGoal>(&goal);
  if (example == nullptr || example->objective == Objective::painted) return;
  core::Rgb sum;
  for (int y = 0; y < example->exemplar.size().height; ++y)
    for (int x = 0; x < example->exemplar.size().width; ++x) sum = sum + example->exemplar.at(x, y);
  asked.exemplar_chroma = measure::terms::chroma_of(sum);
}

void add_sides(core::Size size, const Goal& goal, Asked& asked) {
  for (const CameraShare& camera : asked.wishes->cameras) {
    const Layers& layers = camera.twin->at(size);
    Asked::Side side{
        layers, target_of(goal, size, layers.geometry()), {}, camera.weight, camera.name};
    side.map = map_for(layers, side.target);
    asked.sides.push_back(std::move(side));
  }
}

}  // namespace

measure::terms::Seen seen_of(const Asked& asked, const core::Plane& luminance,
                             const Columns& columns, std::span<const double> levels) {
  measure::terms::Seen seen;
  seen.luminance = &luminance;
  seen.map = &asked.map;
  if (!asked.curvature.empty()) seen.curvature = &asked.curvature;
  seen.exemplar_chroma = asked.exemplar_chroma;
  const auto lux = [&](const std::vector<double>& per_level) {
    double sum = 0;
    for (std::size_t k = 0; k < per_level.size(); ++k) sum += per_level[k] * levels[k];
    return sum;
  };
  if (!columns.key_lux.empty()) {
    seen.key = lux(columns.key_lux);
    seen.fill = lux(columns.fill_lux);
  }
  return seen;
}

double term_cost(const Asked& asked, const measure::terms::Seen& seen) {
  double sum = 0;
  for (const TermShare& share : asked.wishes->terms) {
    const measure::terms::PictureTerm& term = *measure::terms::picture_term(share.name);
    sum += share.weight * term.cost(seen, share.wanted.value_or(term.usual)).value_or(0);
  }
  return sum;
}

std::shared_ptr<Asked> asked_of(std::shared_ptr<const Wishes> wishes, const studio::Studio& studio,
                                const Layers& layers, const Goal& goal) {
  auto asked = std::make_shared<Asked>();
  asked->wishes = std::move(wishes);
  add_shape(layers, goal, *asked);
  add_sides(layers.size(), goal, *asked);
  for (const Wish& wish : asked->wishes->wishes) {
    core::Plane mask = mask_of(wish.region, studio, layers.geometry(), layers.size());
    double sum = 0;
    for (const float v : mask.values) sum += double{v};
    for (float& v : mask.values) v = sum > 0 ? static_cast<float>(v / sum) : 0.0f;
    asked->masks.push_back(std::move(mask));
    asked->mirrors.push_back(wish.kind == Wish::Kind::highlight && layers.geometry() != nullptr
                                 ? mirror_of(wish, studio, *layers.geometry())
                                 : Asked::Mirror{});
  }
  return asked;
}

AskedOfPlaces::AskedOfPlaces(const Setting& setting)
    : setting_(setting), seen_(setting.studio.fixtures.size()) {
  for (const Asked::Side& side : setting.target.asked->sides)
    sides_.push_back(std::make_unique<Workspace>(Setting{
        setting.studio, side.layers, setting.variables, side.target, side.map, setting.accuracy}));
}

std::size_t AskedOfPlaces::lamp_of(const Wish& wish) const {
  if (!wish.lamp.empty()) return setting_.studio.fixture_index(wish.lamp).value_or(0);
  return key_of(setting_.studio).value_or(0);
}

double AskedOfPlaces::hidden(const studio::Rig& rig, std::size_t fixture, const core::Plane& mask) {
  Seen& seen = seen_[fixture];
  core::FixtureState state = rig.states[fixture];
  state.set(core::Dof::intensity, 1);
  if (seen.visible.empty() || !(seen.state == state)) {
    seen.visible = core::Plane(setting_.layers.size());
    setting_.layers.visibility(fixture, state, setting_.accuracy, seen.visible);
    seen.state = state;
  }
  double hidden = 0;
  for (std::size_t i = 0; i < mask.values.size(); ++i)
    hidden += double{mask.values[i]} * (1 - double{seen.visible.values[i]});
  return hidden;
}

/// Of one lamp, or of all of them, each by the light it would throw on the face.
ShadowShare AskedOfPlaces::shadows(const studio::Rig& rig, std::size_t wish) {
  const Wish& each = setting_.target.asked->wishes->wishes[wish];
  const core::Plane& mask = setting_.target.asked->masks[wish];
  ShadowShare share;
  share.weight = each.weight;
  share.wanted = each.kind == Wish::Kind::shadow;
  const auto counted = [&](std::size_t fixture) {
    const bool named = each.lamp.empty() || setting_.studio.fixtures[fixture].name == each.lamp;
    return named && setting_.studio.fixtures[fixture].controlled
               ? lux_on_face(setting_.studio, rig, fixture)
               : 0.0;
  };
  for (const std::size_t fixture : setting_.variables.lit) {
    const double light = counted(fixture);
    share.light.push_back(light);
    share.hidden.push_back(light > 0 ? light * hidden(rig, fixture, mask) : 0);
  }
  for (const std::size_t fixture : setting_.variables.held) {
    const double light = counted(fixture) * rig.states[fixture].get(core::Dof::intensity);
    share.constant += light;
    share.hidden_constant += light > 0 ? light * hidden(rig, fixture, mask) : 0;
  }
  return share;
}

Highlight AskedOfPlaces::highlight(const studio::Rig& rig, std::size_t wish) {
  const Wish& each = setting_.target.asked->wishes->wishes[wish];
  const std::size_t lamp = lamp_of(each);
  const auto& lit = setting_.variables.lit;
  Highlight highlight;
  const auto found = std::find(lit.begin(), lit.end(), lamp);
  if (found != lit.end()) highlight.level = static_cast<std::size_t>(found - lit.begin());
  highlight.lit = rig.states[lamp].get(core::Dof::intensity) > 0;
  highlight.weight = each.weight;
  highlight.off = cost_of_place(each, measured(rig, wish));
  return highlight;
}

double AskedOfPlaces::measured(const studio::Rig& rig, std::size_t wish) {
  const Asked& asked = *setting_.target.asked;
  const Wish& each = asked.wishes->wishes[wish];
  if (about_shadow(each)) {
    std::vector<double> levels;
    for (const std::size_t fixture : setting_.variables.lit)
      levels.push_back(rig.states[fixture].get(core::Dof::intensity));
    return shadows(rig, wish).share(levels);
  }
  const std::size_t lamp = lamp_of(each);
  const Asked::Mirror& mirror = asked.mirrors[wish];
  if (core::length(mirror.lamp) == 0) return core::kPi / 2;
  const Vec3 stands =
      twin::pose(setting_.studio.fixtures[lamp], rig.states[lamp], estimated_aim(setting_.studio))
          .position;
  return std::acos(
      std::clamp(core::dot(core::unit(stands - mirror.at), core::unit(mirror.lamp)), -1.0, 1.0));
}

void AskedOfPlaces::update(const studio::Rig& rig, Columns& columns) {
  const Wishes& wishes = *setting_.target.asked->wishes;
  columns.highlights.clear();
  columns.shadows.clear();
  for (std::size_t w = 0; w < wishes.wishes.size(); ++w)
    if (about_shadow(wishes.wishes[w]))
      columns.shadows.push_back(shadows(rig, w));
    else if (about_place(wishes.wishes[w]))
      columns.highlights.push_back(highlight(rig, w));
  columns.linear = linear_bounds(wishes, setting_.studio, setting_.variables, rig);
  columns.elsewhere.clear();
  for (const auto& side : sides_) columns.elsewhere.push_back(&side->columns(rig));
  if (!wants(wishes, "key_fill")) return;
  columns.key_lux.clear();
  columns.fill_lux.clear();
  for (const std::size_t fixture : setting_.variables.lit) {
    studio::Rig full = rig;
    full.states[fixture].set(core::Dof::intensity, 1);
    const double lux = lux_at_face(setting_.studio, full, fixture);
    const studio::Role role = setting_.studio.fixtures[fixture].role;
    columns.key_lux.push_back(role == studio::Role::key ? lux : 0);
    columns.fill_lux.push_back(role == studio::Role::fill ? lux : 0);
  }
}

double picture_cost(const Wish& wish, const core::Plane& mask, const core::Plane& luminance) {
  if (about_place(wish)) return 0;
  const Moments now = lightness_over(mask, luminance);
  if (wish.kind == Wish::Kind::lightness) return std::abs(now.mean - wish.wanted) / 100;
  const double over = now.spread - wish.wanted;
  return std::max(0.0, wish.kind == Wish::Kind::spread_at_most ? over : -over) / 50;
}

namespace {

/// Each term's cost, and each other camera's, 0 = met.
void add_terms(const Setting& setting, const studio::Rig& rig, const core::Plane& luminance,
               Outcome& outcome) {
  const Asked& asked = *setting.target.asked;
  Workspace workspace(setting);
  const Columns& columns = workspace.columns(rig);
  std::vector<double> levels;
  for (const std::size_t fixture : setting.variables.lit)
    levels.push_back(rig.states[fixture].get(core::Dof::intensity));
  if (!asked.wishes->terms.empty()) {
    const core::Picture colour = predicted(setting.studio, setting.layers, rig, setting.accuracy);
    measure::terms::Seen seen = seen_of(asked, luminance, columns, levels);
    seen.colour = &colour;
    for (const TermShare& share : asked.wishes->terms) {
      const auto& term = *measure::terms::picture_term(share.name);
      if (const auto cost = term.cost(seen, share.wanted.value_or(term.usual)))
        outcome.components.push_back({"cost of " + share.name, 0.0, *cost});
    }
  }
  for (std::size_t s = 0; s < asked.sides.size(); ++s)
    outcome.components.push_back({"cost for camera " + asked.sides[s].name, 0.0,
                                  level_solver(asked.sides[s].target, asked.sides[s].map)
                                      ->cost(*columns.elsewhere[s], levels)});
}

}  // namespace

Outcome outcome_of(const Setting& setting, const studio::Rig& rig, const core::Plane& luminance) {
  Outcome outcome;
  const Asked& asked = *setting.target.asked;
  AskedOfPlaces places(setting);
  for (std::size_t w = 0; w < asked.wishes->wishes.size(); ++w) {
    const Wish& wish = asked.wishes->wishes[w];
    Component component{in_words(wish), wish.wanted, 0};
    if (about_place(wish)) {
      component.value = places.measured(rig, w);
      component.target = wish.kind == Wish::Kind::shadow ? 1 : 0;
      if (wish.weight > 0)
        outcome.worst = std::max(outcome.worst, cost_of_place(wish, component.value));
      if (!about_shadow(wish)) component.value = core::degrees(component.value);
    } else {
      const Moments now = lightness_over(asked.masks[w], luminance);
      component.value = wish.kind == Wish::Kind::lightness ? now.mean : now.spread;
      if (wish.weight > 0)
        outcome.worst = std::max(outcome.worst, picture_cost(wish, asked.masks[w], luminance));
    }
    outcome.components.push_back(std::move(component));
  }
  const auto lines = linear_bounds(*asked.wishes, setting.studio, setting.variables, rig);
  for (std::size_t b = 0; b < asked.wishes->bounds.size(); ++b) {
    const Bound& bound = asked.wishes->bounds[b];
    const LinearBound& line = lines[b];
    double value = line.constant;
    for (std::size_t k = 0; k < line.per_level.size(); ++k)
      value += line.per_level[k] * rig.states[setting.variables.lit[k]].get(core::Dof::intensity);
    const double limit = std::isfinite(line.most) ? line.most : line.least;
    const double scale = limit > 0 ? bound.limit / limit : 1;
    outcome.components.push_back({in_words(bound), bound.limit, scale * value});
    if (!line.holds(value))
      outcome.broken.push_back(in_words(bound) + " cannot be kept: it is " +
                               core::number(scale * value, bound.limit < 10 ? 2 : 0));
  }
  add_terms(setting, rig, luminance, outcome);
  return outcome;
}

}  // namespace chiaro::design
