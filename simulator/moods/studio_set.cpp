// SPDX-License-Identifier: Apache-2.0
#include "simulator/moods/studio_set.h"

#include <cmath>

#include "controller/twin/lights/light_model.h"

namespace chiaro::simulator {
namespace {

using core::Vec3;

struct Aimed {
  twin::Light light;
  Vec3 target;
};

void aim(twin::Light& light, Vec3 target, const core::AimFrame& frame) {
  light.direction = core::unit(target - light.position);
  const Vec3 level = core::cross(light.direction, Vec3{0, 0, 1});
  light.right = core::length(level) > 1e-6 ? core::unit(level) : frame.camera_right;
  light.up = core::cross(light.right, light.direction);
}

core::Rgb colour_of(const RecipeLamp& lamp, core::Kelvin balance) {
  if (!lamp.colour) return core::white_light(lamp.cct, lamp.tint, balance);
  return (1 / core::luminance(*lamp.colour)) * *lamp.colour;
}

Aimed aimed(const RecipeLamp& lamp, const core::AimFrame& frame, core::Kelvin balance) {
  Aimed out;
  twin::Light& light = out.light;
  light.kind = lamp.optic.kind;
  if (const auto* free = std::get_if<FreePlace>(&lamp.place)) {
    light.position = free->at;
    out.target = free->aim_at;
  } else {
    light.position = core::position(frame, std::get<AboutTheSitter>(lamp.place));
    out.target = frame.origin;
  }
  aim(light, out.target, frame);
  light.cos_beam = std::cos(lamp.optic.beam / 2);
  light.cos_field = std::cos(lamp.optic.field / 2);
  light.width = lamp.optic.width;
  light.height = lamp.optic.height;
  light.radius = lamp.optic.radius;
  light.colour = colour_of(lamp, balance);
  return out;
}

/// The first key; the first lamp where none is called so.
std::size_t key_of(const Recipe& recipe) {
  for (std::size_t i = 0; i < recipe.lamps.size(); ++i)
    if (recipe.lamps[i].role == studio::Role::key && recipe.lamps[i].lux) return i;
  return 0;
}

core::Problems dress(studio::Studio& studio, const Recipe& recipe) {
  core::Problems problems;
  studio.fixtures.clear();
  if (recipe.ambient) studio.ambient = recipe.ambient;
  if (recipe.white_balance) studio.exposure.white_balance = *recipe.white_balance;
  for (studio::Subject& subject : studio.subjects) subject.facing += recipe.sitter_turn;
  for (const auto& [name, colour] : recipe.surfaces) {
    bool found = false;
    for (studio::BackgroundPlane& plane : studio.background)
      if (plane.name == name) {
        plane.material.diffuse = colour;
        found = true;
      }
    if (!found)
      problems.push_back({{recipe.studio.string()},
                          "the recipe paints '" + name + "', but the studio has no such plane",
                          "name a plane of its background"});
  }
  return problems;
}

}  // namespace

double candela_for(const twin::Light& light, Vec3 target, double lux) {
  twin::Light one = light;
  one.candela = 1;
  const Vec3 facing = light.kind == studio::Optic::Kind::directional
                          ? -light.direction
                          : core::unit(light.position - target);
  const double given = twin::light_model(light.kind).irradiance(one, target, facing);
  return given > 0 ? lux / given : 0;
}

core::Result<StudioSet> set_up(const Recipe& recipe, const studio::Folders& folders,
                               const std::filesystem::path& cache) {
  auto loaded = studio::load_studio(recipe.studio, folders);
  if (!loaded) return loaded.problems();
  StudioSet set;
  set.key = key_of(recipe);
  set.studio = std::move(loaded->studio);
  if (core::Problems problems = dress(set.studio, recipe); !problems.empty()) return problems;
  auto geometry = twin::build_geometry(set.studio, cache);
  if (!geometry) return geometry.problems();
  set.scene = twin::lit_by(set.studio, *geometry, {});
  for (const RecipeLamp& lamp : recipe.lamps) {
    Aimed lit = aimed(lamp, (*geometry)->aim, set.studio.exposure.white_balance);
    const double lux =
        lamp.lux ? *lamp.lux : *recipe.lamps[set.key].lux / core::from_stops(*lamp.stops_below_key);
    lit.light.candela = candela_for(lit.light, lit.target, lux);
    lit.light.fixture = set.scene.lights.size();
    set.scene.lights.push_back(lit.light);
    set.scene.levels.push_back(1);
  }
  return set;
}

}  // namespace chiaro::simulator
