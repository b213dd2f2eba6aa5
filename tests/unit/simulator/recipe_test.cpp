// SPDX-License-Identifier: Apache-2.0
// Recipes: what is read, what is refused and where, and whether the shipped ones ask of the shipped
// studio's lamps only what these can do.
#include "simulator/moods/recipe.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "controller/twin/lights/light_model.h"
#include "simulator/moods/studio_set.h"

namespace chiaro::simulator {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const studio::Folders kFolders{fs::path(CHIARO_SOURCE) / "config"};

const std::string kGood = R"(title: Test
sentence: A test.
tags: {pattern: loop, tone: mid key, hardness: soft, colour: warm}
studio: portrait
lights:
  key: {role: key, azimuth: -45 deg, elevation: 40 deg, distance: 1.6 m, shape: {softbox: [0.6, 0.9]}, lux: 800 lx, cct: 3200 K}
  fill: {role: fill, azimuth: 40 deg, elevation: 5 deg, distance: 2 m, shape: {disk: 0.3 m}, below_key: 2 stops}
  wall: {role: background, at: [1.6, 0.8, 0.4], aim_at: [0.2, 2, 1.3], shape: {spot: {beam: 50 deg, field: 90 deg}}, lux: 300 lx, colour: [1, 0.4, 0.1]}
)";

core::Result<Recipe> parsed(const std::string& yaml) {
  return parse_recipe(yaml, "recipe.yaml", kFolders);
}
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}
std::string complaint(const std::string& yaml) {
  const auto recipe = parsed(yaml);
  return recipe ? "" : core::to_string(recipe.problems());
}

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolders.moods()))
    if (fs::exists(entry.path() / "recipe.yaml")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}
Recipe recipe_of(const std::string& name) {
  return *load_recipe(kFolders.moods() / name / "recipe.yaml", kFolders);
}

TEST(Recipe, ReadsLampsInAPersonsUnits) {
  const auto recipe = parsed(kGood);
  ASSERT_TRUE(recipe) << core::to_string(recipe.problems());
  ASSERT_EQ(recipe->lamps.size(), 3u);
  const RecipeLamp& key = recipe->lamps[0];
  EXPECT_NEAR(std::get<AboutTheSitter>(key.place).azimuth, core::radians(-45), 1e-12);
  EXPECT_EQ(key.optic.kind, studio::Optic::Kind::rectangle);
  EXPECT_EQ(key.optic.height, 0.9);
  EXPECT_EQ(key.lux, 800);
  EXPECT_EQ(key.cct.value, 3200);
  EXPECT_EQ(recipe->lamps[1].stops_below_key, 2);
  EXPECT_EQ(std::get<FreePlace>(recipe->lamps[2].place).at, (core::Vec3{1.6, 0.8, 0.4}));
  EXPECT_TRUE(recipe->attainable);
}

TEST(Recipe, RefusesWhatItDoesNotKnowWhereItStands) {
  EXPECT_THAT(complaint(with(kGood, "distance: 1.6 m", "distanse: 1.6 m")),
              AllOf(HasSubstr("recipe.yaml:6:"), HasSubstr("distanse"), HasSubstr("distance")));
  EXPECT_THAT(complaint(with(kGood, "-45 deg", "-45")), HasSubstr("recipe.yaml:6:"));
  EXPECT_THAT(complaint(with(kGood, "studio: portrait", "studio: portait")),
              AllOf(HasSubstr("recipe.yaml:4:"), HasSubstr("portait")));
  EXPECT_THAT(complaint(with(kGood, "disk: 0.3 m", "ring: 0.3 m")), HasSubstr("recipe.yaml:7:"));
}

TEST(Recipe, TagsAreChecked) {
  EXPECT_EQ(parsed(kGood)->tags.words(),
            (std::vector<std::string>{"loop", "mid key", "soft", "warm"}));
  EXPECT_THAT(complaint(with(kGood, "pattern: loop", "pattern: lop")),
              AllOf(HasSubstr("recipe.yaml:3:"), HasSubstr("loop")));
  EXPECT_THAT(complaint(with(kGood, ", colour: warm", "")),
              AllOf(HasSubstr("recipe.yaml:3:"), HasSubstr("colour")));
  EXPECT_THAT(complaint(with(kGood, "tags: {", "tags: {mood: dark, ")), HasSubstr("mood"));
}

TEST(Recipe, SitterCameraAndWordsAreRead) {
  const auto recipe =
      parsed(kGood + "sitter_turn: -35 deg\nwhite_balance: 3200 K\nwords: [cosy, night]\n");
  ASSERT_TRUE(recipe) << core::to_string(recipe.problems());
  EXPECT_NEAR(recipe->sitter_turn, core::radians(-35), 1e-12);
  EXPECT_EQ(recipe->white_balance->value, 3200);
  EXPECT_EQ(recipe->words, (std::vector<std::string>{"cosy", "night"}));
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_TRUE(set);
  // 3200 K before a camera balanced for it is white.
  const core::Rgb key = set->scene.lights[0].colour;
  EXPECT_NEAR(key.r, key.b, 0.02);
}

TEST(Recipe, ReportsEveryProblemAtOnce) {
  const auto recipe = parsed(
      with(with(with(kGood, "1.6 m", "1.6"), "800 lx", "800 K"), "role: fill", "role: film"));
  ASSERT_FALSE(recipe);
  EXPECT_GE(recipe.problems().size(), 3u);
}

TEST(Recipe, StrengthIsSaidOnceAndNeedsAKeyToBeBelow) {
  EXPECT_THAT(complaint(with(kGood, "below_key: 2 stops", "below_key: 2 stops, lux: 5 lx")),
              HasSubstr("recipe.yaml:7:"));
  EXPECT_THAT(complaint(with(kGood, ", lux: 800 lx", "")), HasSubstr("recipe.yaml:6:"));
  EXPECT_THAT(complaint(with(kGood, "role: key", "role: hair")), HasSubstr("needs a key"));
}

TEST(Recipe, MissingFileIsAProblemNotACrash) {
  const auto recipe = load_recipe("/no/such/recipe.yaml", kFolders);
  ASSERT_FALSE(recipe);
  EXPECT_THAT(core::to_string(recipe.problems()), HasSubstr("/no/such/recipe.yaml"));
}

TEST(Recipe, EveryPrefixOfAGoodOneLoadsOrComplains) {
  for (std::size_t n = 0; n < kGood.size(); n += 7) {
    const auto recipe = parsed(kGood.substr(0, n));
    if (!recipe) {
      EXPECT_FALSE(recipe.problems().empty());
    }
  }
}

TEST(StudioSet, LampsGiveTheLuxThatTheRecipeSays) {
  const auto recipe = parsed(kGood);
  ASSERT_TRUE(recipe);
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_TRUE(set) << core::to_string(set.problems());
  const core::Vec3 aim = set->scene.geometry->aim.origin;
  const auto lux = [&](std::size_t i, core::Vec3 target) {
    const twin::Light& light = set->scene.lights[i];
    return twin::light_model(light.kind)
        .irradiance(light, target, core::unit(light.position - target));
  };
  EXPECT_NEAR(lux(0, aim), 800, 0.1);
  EXPECT_NEAR(lux(1, aim), 200, 0.1);
  EXPECT_NEAR(lux(2, {0.2, 2, 1.3}), 300, 0.1);
  EXPECT_NEAR(core::luminance(set->scene.lights[2].colour), 1, 1e-9);
}

TEST(StudioSet, RefusesToPaintAPlaneThatIsNotThere) {
  const auto recipe = parsed(kGood + "background: {curtain: 0.1}\n");
  ASSERT_TRUE(recipe);
  const auto set = set_up(*recipe, kFolders, {});
  ASSERT_FALSE(set);
  EXPECT_THAT(core::to_string(set.problems()), HasSubstr("curtain"));
}

TEST(ShippedRecipes, AllLoadAndAtLeastTwelveAreAttainable) {
  int attainable = 0;
  for (const std::string& name : shipped()) {
    const auto recipe = load_recipe(kFolders.moods() / name / "recipe.yaml", kFolders);
    ASSERT_TRUE(recipe) << core::to_string(recipe.problems());
    attainable += recipe->attainable;
    EXPECT_GE(recipe->words.size(), 3u) << name;
  }
  EXPECT_GE(attainable, 12);
  for (const char* name : {"rembrandt", "loop", "butterfly", "clamshell", "split", "broad", "short",
                           "rim", "silhouette", "high-key", "low-key", "film-noir", "horror",
                           "golden-hour", "moonlight", "candlelight"})
    EXPECT_THAT(shipped(), ::testing::Contains(name));
}

/// The studio's fixture that plays that role.
const studio::Fixture* player(const studio::Studio& studio, studio::Role role) {
  for (const studio::Fixture& fixture : studio.fixtures)
    if (fixture.role == role) return &fixture;
  return nullptr;
}

double across(const studio::Optic& optic) {
  using Kind = studio::Optic::Kind;
  return optic.kind == Kind::rectangle ? std::max(optic.width, optic.height)
         : optic.kind == Kind::disk    ? 2 * optic.radius
                                       : 0;
}

void expect_place(const RecipeLamp& lamp, const studio::Fixture& fixture) {
  if (const auto* free = std::get_if<FreePlace>(&lamp.place)) {
    const auto* mount = std::get_if<studio::FixedMount>(&fixture.mount);
    ASSERT_NE(mount, nullptr);
    EXPECT_LT(core::distance(free->at, mount->at), 1e-9);
    EXPECT_LT(core::distance(free->aim_at, mount->aim_at), 1e-9);
    return;
  }
  const auto& place = std::get<AboutTheSitter>(lamp.place);
  const auto* stand = std::get_if<studio::StandMount>(&fixture.mount);
  ASSERT_NE(stand, nullptr);
  EXPECT_TRUE(stand->region.azimuth.contains(place.azimuth));
  EXPECT_TRUE(stand->region.elevation.contains(place.elevation));
  EXPECT_TRUE(stand->region.distance.contains(place.distance));
}

TEST(ShippedRecipes, AttainableOnesAskOnlyWhatTheStudiosLampsCanDo) {
  for (const std::string& name : shipped()) {
    const Recipe recipe = recipe_of(name);
    if (!recipe.attainable) continue;
    SCOPED_TRACE(name);
    const auto real = studio::load_studio(recipe.studio, kFolders);
    ASSERT_TRUE(real);
    const auto set = set_up(recipe, kFolders, {});
    ASSERT_TRUE(set);
    EXPECT_TRUE(recipe.surfaces.empty());
    EXPECT_FALSE(recipe.ambient);
    for (std::size_t i = 0; i < recipe.lamps.size(); ++i) {
      const RecipeLamp& lamp = recipe.lamps[i];
      SCOPED_TRACE(lamp.name);
      const studio::Fixture* fixture = player(real->studio, lamp.role);
      ASSERT_NE(fixture, nullptr);
      // A smaller source than the studio's is drawn for its harder edge, a larger one never.
      EXPECT_LE(across(lamp.optic), across(fixture->fitted_optic()));
      EXPECT_LE(set->scene.lights[i].candela, fixture->fitted_output().value);
      if (fixture->profile.emitter.kind == studio::Emitter::Kind::bicolour) {
        const double mired = 1e6 / lamp.cct.value - 1e6 / set->studio.exposure.white_balance.value +
                             1e6 / real->studio.exposure.white_balance.value;
        EXPECT_TRUE(fixture->profile.emitter.cct_range.contains(1e6 / mired)) << 1e6 / mired;
      }
      expect_place(lamp, *fixture);
    }
  }
}

}  // namespace
}  // namespace chiaro::simulator
