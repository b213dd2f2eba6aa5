// SPDX-License-Identifier: Apache-2.0
#include "controller/design/ideal.h"

#include <gtest/gtest.h>

#include "controller/design/design.h"
#include "controller/design/stages.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{64, 64};

studio::Studio four_lamps() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-40), core::radians(30), 1.8}, 6000),
                     support::stand_lamp("fill", studio::Role::fill,
                                         {core::radians(40), core::radians(10), 2.0}, 3000),
                     support::stand_lamp("back", studio::Role::back,
                                         {core::radians(150), core::radians(10), 1.4}, 2000),
                     support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 800)};
  return studio;
}

/// Everything a stage-two call needs, on the analytic twin.
struct Stage {
  studio::Studio studio = four_lamps();
  support::AnalyticSource twin{studio};
  Options options;
  Variables variables = variables_of(studio, options);
  Target target = target_of(IdealGoal{}, kSize);
  measure::PixelMap map = map_for(twin.at(kSize), target);
  Setting setting{studio, twin.at(kSize), variables, target, map, Accuracy::exact};
  studio::Rig rig = studio::placed_rig(studio);
  Stage() {
    support::stand(rig, 0, -40, 30, 1.8, 0.4);
    support::stand(rig, 1, 40, 10, 2.0, 0.2);
    support::stand(rig, 2, 150, 10, 1.4, 0);
  }
};

TEST(IdealStages, StageTwoTouchesOnlyTheBackLight) {
  Stage stage;
  const studio::Rig after = with_back_lights(stage.setting, stage.rig, true);
  EXPECT_EQ(after.states[0], stage.rig.states[0]);
  EXPECT_EQ(after.states[1], stage.rig.states[1]);
  EXPECT_EQ(after.states[3], stage.rig.states[3]);
  EXPECT_NE(after.states[2], stage.rig.states[2]);
}

// [I-24]
TEST(IdealStages, BackLightStaysBehindAndWithinItsElevations) {
  Stage stage;
  const studio::Rig after = with_back_lights(stage.setting, stage.rig, true);
  EXPECT_GT(after.states[2].get(core::Dof::intensity), 0);
  EXPECT_GE(core::degrees(after.states[2].get(core::Dof::azimuth)), 120);
  EXPECT_DOUBLE_EQ(after.states[2].get(core::Dof::distance), 1.4);
  const double elevation = core::degrees(after.states[2].get(core::Dof::elevation));
  EXPECT_TRUE(elevation >= 29.9 && elevation <= 70.1) << elevation;
}

// [I-24]
TEST(IdealStages, BackLightShowsMoreOfTheOuterSilhouette) {
  Stage stage;
  const auto silhouette = silhouette_of(stage.map);
  const auto share = [&](const studio::Rig& rig) {
    core::Plane sum(kSize), layer(kSize);
    for (std::size_t i = 0; i < rig.states.size(); ++i) {
      stage.twin.at(kSize).luminance(i, rig.states[i], Accuracy::exact, layer);
      for (std::size_t p = 0; p < sum.values.size(); ++p)
        sum.values[p] +=
            static_cast<float>(rig.states[i].get(core::Dof::intensity)) * layer.values[p];
    }
    return silhouette_share(sum, silhouette);
  };
  // Weak frontal light: the sphere's rim is as dark as the wall until the back light comes.
  stage.rig.states[0].set(core::Dof::intensity, 0.02);
  stage.rig.states[1].set(core::Dof::intensity, 0.02);
  EXPECT_GT(share(with_back_lights(stage.setting, stage.rig, true)), share(stage.rig) + 0.05);
}

TEST(IdealStages, BackLightThatMayNotMoveKeepsItsPlace) {
  Stage stage;
  const studio::Rig after = with_back_lights(stage.setting, stage.rig, false);
  for (const core::Dof dof : {core::Dof::azimuth, core::Dof::elevation, core::Dof::distance})
    EXPECT_EQ(after.states[2].get(dof), stage.rig.states[2].get(dof));
}

TEST(IdealStages, BackgroundLightNeverMakesTheWallBrighterThanTheSubject) {
  Stage stage;
  stage.studio.fixtures[3].output = core::Candela{50000};
  const studio::Rig after = with_background_lights(stage.setting, stage.rig);
  EXPECT_LT(after.states[3].get(core::Dof::intensity), 0.1);
}

TEST(IdealStages, StageOneHasOnlyTheLampsThatFaceTheSubject) {
  Stage stage;
  stage.rig.states[2].set(core::Dof::intensity, 0.5);
  const Variables shape = variables_of(stage.studio, stage.variables, IdealStage::shape, stage.rig);
  EXPECT_EQ(shape.lit, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(shape.held, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(shape.base.states[2].get(core::Dof::intensity), 0);
  EXPECT_EQ(shape.moving.size(), 6u);
}

// [I-13]
TEST(IdealStages, AttainableTargetsAreAboveWhatAnyLitPictureOfTheKeyShows) {
  Stage stage;
  const auto most = attainable_targets(stage.setting);
  core::Plane key(kSize);
  stage.twin.at(kSize).luminance(0, stage.rig.states[0], Accuracy::exact, key);
  EXPECT_GT(most.gradient, 0.5 * measure::components_of_luminance(key, stage.map).gradient);
  EXPECT_GT(most.contrast, 0);
  EXPECT_EQ(most.mean, stage.target.ideal.mean);
}

TEST(IdealDesign, LightsTheShapeWithoutAnExemplar) {
  const studio::Studio studio = four_lamps();
  Options options;
  options.search_size = options.polish_size = options.full_size = kSize;
  options.trials = 120;
  options.threads = 2;
  const auto look = design(studio, support::AnalyticSource(studio), IdealGoal{}, options);
  ASSERT_TRUE(look.ok());
  EXPECT_GT(look->wanted.states[0].get(core::Dof::intensity), 0.02);
  EXPECT_NEAR(look->components[1].value, 127.5, 30);
  EXPECT_EQ(look->goal, "ideal");
}

// [I-5]
TEST(IdealDesign, KeepsTheKeyInFrontAndAbove) {
  const studio::Studio studio = four_lamps();
  const Variables all = variables_of(studio, {});
  ExampleGoal perceptual;
  perceptual.objective = Objective::perceptual;
  for (const Goal& goal : {Goal(IdealGoal{}), Goal(perceptual)}) {
    const Variables lamps = searched(studio, all, goal);
    EXPECT_EQ(lamps.moving[1].dof, core::Dof::elevation);
    EXPECT_EQ(lamps.moving[1].range.least, 0) << "the key";
    EXPECT_LT(lamps.moving[4].range.least, 0) << "the fill may come from below";
  }
  // A picture compared place by place tells by itself where its light comes from.
  EXPECT_LT(searched(studio, all, Goal(ExampleGoal{})).moving[1].range.least, 0);
}

TEST(IdealDesign, NeedsAShape) {
  EXPECT_FALSE(problems_of(IdealGoal{}, false).empty());
  EXPECT_TRUE(problems_of(IdealGoal{}, true).empty());
}

}  // namespace
}  // namespace chiaro::design
