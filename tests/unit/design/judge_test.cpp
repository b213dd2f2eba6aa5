// SPDX-License-Identifier: Apache-2.0
// Verdicts: what is reached, what is not, which lamp is short by how much and what would help.
#include "controller/design/judge.h"

#include <gtest/gtest.h>

#include "controller/design/design.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{64, 64};

studio::Studio key_on_stand(double candela) {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-40), core::radians(30), 2.2}, candela)};
  return studio;
}

core::Picture lit_by_full(double candela) {
  const studio::Studio strong = key_on_stand(candela);
  studio::Rig rig = studio::placed_rig(strong);
  rig.states[0].set(core::Dof::intensity, 1);
  return support::photographed(strong, support::AnalyticSource(strong), rig, kSize);
}

Look level_only(const studio::Studio& studio, const Goal& goal, bool advise = false) {
  Options options;
  options.search_size = options.polish_size = options.full_size = kSize;
  options.move_stands = false;
  options.advise_exposure = advise;
  auto look = design(studio, support::AnalyticSource(studio), goal, options);
  EXPECT_TRUE(look.ok()) << core::to_string(look.problems());
  return look ? *look : Look{};
}

TEST(Verdict, IsReachedWhenTheLampCanDoIt) {
  const Look look = level_only(key_on_stand(4000), support::like(lit_by_full(2000)));
  EXPECT_EQ(look.judgement.verdict, Verdict::reached);
  EXPECT_NEAR(look.wanted.states[0].get(core::Dof::intensity), 0.5, 0.01);
  EXPECT_EQ(look.judgement.limiting_fixture, "");
  EXPECT_EQ(look.judgement.remedy, "");
}

TEST(Verdict, NamesTheLampThatIsShortAndByHowManyStops) {
  const Look look = level_only(key_on_stand(1000), support::like(lit_by_full(2500)));
  EXPECT_NE(look.judgement.verdict, Verdict::reached);
  EXPECT_EQ(look.judgement.limiting_fixture, "key");
  EXPECT_NEAR(look.judgement.missing_stops, 1.32, 0.1);
  EXPECT_EQ(look.judgement.remedy,
            "key 1⅓ stops short: bring it to 1.39 m, or expose the camera 1⅓ stops more");
}

TEST(Verdict, SaysIsoWhenTheCameraHasOneAndOmitsPlacesOutOfReach) {
  studio::Studio studio = key_on_stand(500);
  studio.exposure = {};
  studio.cameras[0].iso = 100;
  const Look look = level_only(studio, support::like(lit_by_full(2500)));
  EXPECT_EQ(look.judgement.remedy.find("bring it"), std::string::npos) << look.judgement.remedy;
  EXPECT_NE(look.judgement.remedy.find("ISO 500"), std::string::npos) << look.judgement.remedy;
}

TEST(Verdict, OffersToTakeTheModifierOff) {
  studio::Studio studio = key_on_stand(1000);
  studio.fixtures[0].modifiers = {{"softbox", 0.6, 0.9, 1.3}};
  const Look look = level_only(studio, support::like(lit_by_full(2500)));
  EXPECT_NE(look.judgement.remedy.find("take its softbox off"), std::string::npos)
      << look.judgement.remedy;
}

TEST(Verdict, ADifferentSceneIsNotReachable) {
  // Bands that no lamp can paint on a sphere.
  core::Picture bands(kSize);
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const double v = (y / 8) % 2 == 0 ? 0.9 : 0.0;
      bands.set(x, y, {v, v, v});
    }
  const Look look = level_only(key_on_stand(8000), support::like(bands));
  EXPECT_EQ(look.judgement.verdict, Verdict::not_reachable);
  EXPECT_FALSE(look.judgement.remedy.empty());
}

TEST(Verdict, AsksForABackgroundLightWhereTheWallStaysDark) {
  studio::Studio with_wall = key_on_stand(3000);
  with_wall.fixtures.push_back(
      support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 800));
  studio::Rig rig = studio::placed_rig(with_wall);
  rig.states[0].set(core::Dof::intensity, 0.3);
  rig.states[1].set(core::Dof::intensity, 1);
  const auto picture =
      support::photographed(with_wall, support::AnalyticSource(with_wall), rig, kSize);
  const Look look = level_only(key_on_stand(3000), support::like(picture));
  EXPECT_NE(look.judgement.verdict, Verdict::reached);
  EXPECT_NE(look.judgement.remedy.find("add a background light"), std::string::npos)
      << look.judgement.remedy;
}

TEST(Verdict, AdvisedExposureIsReportedAndMakesUpForTheShortLamp) {
  const auto picture = lit_by_full(2500);
  const Look locked = level_only(key_on_stand(1000), support::like(picture), false);
  EXPECT_EQ(locked.exposure_advice_stops, 0);
  const Look advised = level_only(key_on_stand(1000), support::like(picture), true);
  EXPECT_NEAR(advised.exposure_advice_stops, 4.0 / 3, 1e-9);
  EXPECT_EQ(advised.judgement.verdict, Verdict::reached);
  ASSERT_FALSE(advised.instructions.empty());
  EXPECT_EQ(advised.instructions.front(), "expose the camera 1⅓ stops more");
}

TEST(Verdict, IdealIsReachedUnlessALampIsShort) {
  EXPECT_EQ(level_only(key_on_stand(20000), IdealGoal{}).judgement.verdict, Verdict::reached);
  const Look dim = level_only(key_on_stand(100), IdealGoal{});
  EXPECT_NE(dim.judgement.verdict, Verdict::reached);
  EXPECT_EQ(dim.judgement.limiting_fixture, "key");
}

TEST(Verdict, PerceptualResidualIsTheMeanDeviationOfTheComponents) {
  const Look look =
      level_only(key_on_stand(4000), support::like(lit_by_full(2000), Objective::perceptual));
  EXPECT_LT(look.judgement.residual, 0.05);
  double sum = 0;
  int count = 0;
  for (const Component& component : look.components)
    if (component.target && *component.target > 0) {
      sum += std::abs(component.value / *component.target - 1);
      ++count;
    }
  EXPECT_NEAR(look.judgement.residual, sum / count, 1e-9);
}

}  // namespace
}  // namespace chiaro::design
