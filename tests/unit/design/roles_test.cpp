// SPDX-License-Identifier: Apache-2.0
// What a photographer expects of the answer beside its light: the key is the key, idle lamps are
// dark and stay where they stand, flash powers are ones that can be set.
#include "controller/design/roles.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/design/words.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{64, 64};

studio::Studio key_and_fill() {
  studio::Studio studio = support::analytic_studio();
  studio.fixtures = {support::stand_lamp("key", studio::Role::key,
                                         {core::radians(-40), core::radians(30), 1.8}, 6000),
                     support::stand_lamp("fill", studio::Role::fill,
                                         {core::radians(40), core::radians(10), 2.0}, 6000)};
  return studio;
}

Options quick() {
  Options options;
  options.search_size = options.polish_size = options.full_size = kSize;
  options.trials = 300;
  options.threads = 1;
  return options;
}

struct Scene {
  studio::Studio studio = key_and_fill();
  support::AnalyticSource twin{studio};
  studio::Rig rig = studio::placed_rig(studio);
  core::Picture picture() { return support::photographed(studio, twin, rig, kSize); }
  Look look(const Options& options = quick()) {
    auto result = design(studio, twin, support::like(picture()), options);
    EXPECT_TRUE(result.ok());
    return result ? *result : Look{};
  }
};

TEST(Roles, TheFillGivesItsPlaceToTheKeyWhenItCameOutBrighter) {
  Scene scene;
  Options options = quick();
  const Variables variables = variables_of(scene.studio, options);
  support::stand(scene.rig, 0, -50, 40, 1.7, 0.6);
  support::stand(scene.rig, 1, 30, 5, 2.0, 0.1);
  const Target target = target_of(support::like(scene.picture()), kSize);
  const auto map = measure::flat_pixel_map(kSize);
  const Setting setting{scene.studio, scene.twin.at(kSize), variables, target,
                        map,          Accuracy::cached};
  studio::Rig crossed = scene.rig;
  support::stand(crossed, 0, 30, 5, 2.0, 0);
  support::stand(crossed, 1, -50, 40, 1.7, 0);
  Watch watch(options);
  const double cost = Workspace(setting).solve(crossed, Effort::quick).cost;
  const Found kept = with_roles_kept(setting, {variables.point(crossed), cost}, options, watch);
  EXPECT_LT(support::angle_off(variables.rig(kept.point), scene.rig, 0), 3);
  EXPECT_LE(kept.cost, 1.05 * cost);
}

TEST(Roles, ALampThatThePictureDoesNotNeedGoesDarkAndStaysWhereItStands) {
  Scene scene;
  support::stand(scene.rig, 0, -50, 40, 1.7, 0.6);
  const Look look = scene.look();
  EXPECT_GT(look.wanted.states[0].get(core::Dof::intensity), 0.2);
  EXPECT_EQ(look.wanted.states[1].get(core::Dof::intensity), 0);
  EXPECT_EQ(look.wanted.states[1].get(core::Dof::azimuth), core::radians(40));
  for (const std::string& line : look.instructions)
    EXPECT_EQ(line.find("fill"), std::string::npos) << line;
}

TEST(Roles, FlashPowersAreWholeThirdsOfAStop) {
  Scene scene;
  scene.studio.fixtures[0].by_hand = {{core::Dof::intensity, studio::HandKind::flash_power, {}}};
  support::stand(scene.rig, 0, -50, 40, 1.7, 0.37);
  support::stand(scene.rig, 1, 30, 5, 2.0, 0.2);
  const Look look = scene.look();
  for (const studio::Rig* rig : {&look.wanted, &look.placed}) {
    const double thirds = -3 * std::log2(rig->states[0].get(core::Dof::intensity));
    EXPECT_NEAR(thirds, std::round(thirds), 1e-9);
  }
}

TEST(Roles, RatioNamesTheBrighterLampFirst) {
  Scene scene;
  support::stand(scene.rig, 0, -50, 40, 2, 0.1);
  support::stand(scene.rig, 1, 30, 5, 2, 0.4);
  EXPECT_EQ(ratio_in_words(scene.studio, scene.rig), "fill to key 4:1 (2 stops)");
  scene.rig.states[1].set(core::Dof::intensity, 0);
  EXPECT_EQ(ratio_in_words(scene.studio, scene.rig), "");
}

}  // namespace
}  // namespace chiaro::design
