// SPDX-License-Identifier: Apache-2.0
#include "controller/design/colours.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{64, 64};

studio::Fixture bicolour(studio::Fixture fixture) {
  fixture.profile.emitter.kind = studio::Emitter::Kind::bicolour;
  fixture.profile.emitter.cct_range = {2800, 6500};
  fixture.initial.set(core::Dof::cct, 5600);
  return fixture;
}

studio::Fixture rgb(studio::Fixture fixture) {
  studio::Emitter& emitter = fixture.profile.emitter;
  emitter.kind = studio::Emitter::Kind::mixed;
  emitter.primaries = {{core::Dof::red, {0.68, 0.31}, 0.25},
                       {core::Dof::green, {0.21, 0.71}, 0.60},
                       {core::Dof::blue, {0.15, 0.06}, 0.15}};
  for (const core::Dof dof : {core::Dof::red, core::Dof::green, core::Dof::blue})
    fixture.initial.set(dof, 1);
  return fixture;
}

studio::Studio warm_and_coloured() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {
      bicolour(support::fixed_lamp("key", studio::Role::key, {-1.2, -1.2, 2.2}, 5000)),
      bicolour(support::fixed_lamp("fill", studio::Role::fill, {1.4, -1.6, 1.5}, 2500)),
      rgb(support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 900))};
  return studio;
}

struct Fit {
  studio::Studio studio = warm_and_coloured();
  support::AnalyticSource twin{studio};
  Variables variables = variables_of(studio, Options{});
  studio::Rig hidden = studio::placed_rig(studio);
  studio::Rig white = hidden;
  Fit() {
    for (studio::Rig* rig : {&hidden, &white}) {
      rig->states[0].set(core::Dof::intensity, 0.5);
      rig->states[1].set(core::Dof::intensity, 0.3);
      rig->states[2].set(core::Dof::intensity, 0.4);
    }
  }
  /// As in a design: levels, solved first, already give each lamp its luminance.
  void match_luminance() {
    const auto luminance = [&](const studio::Rig& rig, std::size_t lamp) {
      return core::luminance(studio::light_colour(studio.fixtures[lamp], rig.states[lamp],
                                                  studio.exposure.white_balance));
    };
    for (std::size_t lamp = 0; lamp < 3; ++lamp)
      white.states[lamp].set(core::Dof::intensity, hidden.states[lamp].get(core::Dof::intensity) *
                                                       luminance(hidden, lamp) /
                                                       luminance(white, lamp));
  }
  studio::Rig solved(core::Picture exemplar) {
    const Target target = target_of(support::like(std::move(exemplar)), kSize);
    const auto map = measure::flat_pixel_map(kSize);
    return with_colours({studio, twin.at(kSize), variables, target, map, Accuracy::exact}, white);
  }
};

TEST(Colours, FindHiddenColourTemperatures) {
  Fit fit;
  fit.hidden.states[0].set(core::Dof::cct, 3200);
  fit.hidden.states[1].set(core::Dof::cct, 6300);
  fit.match_luminance();
  const studio::Rig solved =
      fit.solved(support::photographed(fit.studio, fit.twin, fit.hidden, kSize));
  // 10 mired is what a person just sees.
  EXPECT_NEAR(1e6 / solved.states[0].get(core::Dof::cct), 1e6 / 3200, 10);
  EXPECT_NEAR(1e6 / solved.states[1].get(core::Dof::cct), 1e6 / 6300, 10);
}

TEST(Colours, AskForNoTintThatTheModeDoesNotCarry) {
  Fit fit;
  // The lamp could; its mode has no channel for it.
  for (std::size_t lamp : {0u, 1u})
    fit.studio.fixtures[lamp].profile.emitter.tint_range = {-10, 10};
  fit.hidden.states[0].set(core::Dof::cct, 3200);
  fit.hidden.states[0].set(core::Dof::tint, -8);
  fit.match_luminance();
  const studio::Rig solved =
      fit.solved(support::photographed(fit.studio, fit.twin, fit.hidden, kSize));
  EXPECT_LT(solved.states[0].get(core::Dof::cct), 4500);
  EXPECT_EQ(solved.states[0].get(core::Dof::tint), 0);
  EXPECT_EQ(solved.states[1].get(core::Dof::tint), 0);
}

TEST(Colours, FindHiddenDrivesOfAColouredLamp) {
  Fit fit;
  fit.hidden.states[2].set(core::Dof::red, 0.2);
  fit.hidden.states[2].set(core::Dof::green, 0.4);
  fit.match_luminance();
  const studio::Rig solved =
      fit.solved(support::photographed(fit.studio, fit.twin, fit.hidden, kSize));
  const core::FixtureState& wall = solved.states[2];
  const double most =
      std::max({wall.get(core::Dof::red), wall.get(core::Dof::green), wall.get(core::Dof::blue)});
  EXPECT_DOUBLE_EQ(most, 1);
  EXPECT_NEAR(wall.get(core::Dof::red), 0.2, 0.06);
  EXPECT_NEAR(wall.get(core::Dof::green), 0.4, 0.06);
}

TEST(Colours, KeepEachLampsLuminance) {
  Fit fit;
  fit.hidden.states[0].set(core::Dof::cct, 3000);
  fit.hidden.states[2].set(core::Dof::red, 0.3);
  const studio::Rig solved =
      fit.solved(support::photographed(fit.studio, fit.twin, fit.hidden, kSize));
  for (std::size_t lamp = 0; lamp < 3; ++lamp) {
    const auto light = [&](const studio::Rig& rig) {
      return rig.states[lamp].get(core::Dof::intensity) *
             core::luminance(studio::light_colour(fit.studio.fixtures[lamp], rig.states[lamp],
                                                  fit.studio.exposure.white_balance));
    };
    EXPECT_NEAR(light(solved) / light(fit.white), 1, 1e-6) << lamp;
  }
}

TEST(Colours, AGreyPictureLeavesThemAlone) {
  Fit fit;
  core::Picture grey = support::photographed(fit.studio, fit.twin, fit.hidden, kSize);
  const core::Plane luminance = core::luminance(grey);
  grey.red = grey.green = grey.blue = luminance;
  EXPECT_EQ(fit.solved(grey), fit.white);
}

TEST(Colours, ADarkLampKeepsItsColour) {
  Fit fit;
  fit.hidden.states[0].set(core::Dof::cct, 3000);
  fit.white.states[1].set(core::Dof::intensity, 0);
  const studio::Rig solved =
      fit.solved(support::photographed(fit.studio, fit.twin, fit.hidden, kSize));
  EXPECT_EQ(solved.states[1], fit.white.states[1]);
}

TEST(Colours, WhiteBalanceAdviceFindsAWarmPicture) {
  Fit fit;
  const core::Picture ours = support::photographed(fit.studio, fit.twin, fit.white, kSize);
  core::Picture warm(kSize);
  const core::Rgb shift = core::white_light(core::Kelvin{5600}, 0, core::Kelvin{7500});
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) warm.set(x, y, shift * ours.at(x, y));
  const Target target = target_of(support::like(warm), kSize);
  const auto kelvin = better_white_balance(target, ours, core::Kelvin{5600});
  ASSERT_TRUE(kelvin.has_value());
  EXPECT_NEAR(*kelvin, 7500, 200);
  EXPECT_FALSE(better_white_balance(target_of(support::like(ours), kSize), ours, core::Kelvin{5600})
                   .has_value());
}

}  // namespace
}  // namespace chiaro::design
