// SPDX-License-Identifier: Apache-2.0
// Geometry worked by hand.
#include "controller/design/comfort.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/design/colours.h"
#include "controller/studio/load.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/fake_world.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

using core::Vec3;

// An upright glass at the origin facing -Y, a camera 2 m before it. The mirrored ray leaves at the
// angle at which it came.
const Lens kUpright{{0, 0, 0}, {0, -1, 0}, 0.026, 0.020};
const Vec3 kCamera{0, -2, 0};

TEST(Glasses, ALampBesideTheCameraShows) {
  EXPECT_TRUE(shows_in(kUpright, {0, -2, 0}, 0, kCamera));
  // 2 m away and 4 cm aside: the ray passes the glass 2 cm aside, within 2.6 cm.
  EXPECT_TRUE(shows_in(kUpright, {0.04, -2, 0}, 0, kCamera));
  // 8 cm aside: 4 cm, beyond its edge.
  EXPECT_FALSE(shows_in(kUpright, {0.08, -2, 0}, 0, kCamera));
}

TEST(Glasses, ALargeLampShowsFromFurtherAside) {
  // The same 4 cm, but half of the lamp's 60 cm seen half-way reaches 15 cm.
  EXPECT_TRUE(shows_in(kUpright, {0.08, -2, 0}, 0.3, kCamera));
  EXPECT_FALSE(shows_in(kUpright, {1.5, -2, 0}, 0.3, kCamera));
}

TEST(Glasses, BehindTheGlassNothingShows) {
  EXPECT_FALSE(shows_in(kUpright, {0, 1, 0}, 0.5, kCamera));
  EXPECT_FALSE(shows_in(kUpright, {0, -1, 0}, 0.5, {0, 2, 0}));
}

TEST(Glasses, LeanForwardSoThatLowLampsShow) {
  Eyes eyes;
  eyes.right = {-0.0315, 0, 0};
  eyes.left = {0.0315, 0, 0};
  const auto lenses = glasses_on(eyes);
  EXPECT_NEAR(lenses[0].normal.z, -std::sin(core::radians(8)), 1e-12);
  // Leaning by 8 degrees, a camera level with the glass sees what is 16 degrees below it.
  const Vec3 camera = lenses[0].centre + Vec3{0, -2, 0};
  const double fall = std::tan(core::radians(16));
  EXPECT_TRUE(shows_in(lenses[0], lenses[0].centre + Vec3{0, -2, -2 * fall}, 0, camera));
  EXPECT_FALSE(shows_in(lenses[0], lenses[0].centre + Vec3{0, -2, 0}, 0, camera));
}

TEST(CatchLight, StandsHalfWayBetweenLampAndCamera) {
  const Vec3 eye{}, gaze{0, -1, 0}, camera{0, -2, 0};
  const auto at = [](double degrees) {
    return Vec3{2 * std::sin(core::radians(degrees)), -2 * std::cos(core::radians(degrees)), 0};
  };
  EXPECT_TRUE(catches(eye, gaze, at(69), camera));   // half of it is 34.5 degrees
  EXPECT_FALSE(catches(eye, gaze, at(71), camera));  // 35.5
  EXPECT_FALSE(catches(eye, gaze, at(180), camera));
}

TEST(Eyes, AreSixtyThreeMillimetresApartAndLookWhereTheSitterFaces) {
  studio::Studio studio = support::analytic_studio();
  const Eyes eyes = eyes_of(studio);
  EXPECT_NEAR(core::distance(eyes.left, eyes.right), 0.063, 1e-12);
  if (studio.subjects.empty()) return;
  studio.subjects.front().facing = core::radians(90);
  EXPECT_NEAR(eyes_of(studio).gaze.x, 1, 1e-9);  // to the camera's right
}

class ComfortOfALook : public testing::Test {
 protected:
  ComfortOfALook() {
    studio_.fixtures = {support::fixed_lamp("key", studio::Role::key, {-1.2, -1.2, 2.2}, 3000)};
    if (studio_.subjects.empty()) studio_.subjects.emplace_back();
    studio_.subjects.front().aim = Vec3{0, 0, 1.4};
  }
  Comfort found(double level) {
    rig_ = studio::placed_rig(studio_);
    rig_.states[0].set(core::Dof::intensity, level);
    const support::AnalyticLayers layers(studio_, {64, 64});
    return comfort_of(studio_, layers, rig_, predicted(studio_, layers, rig_, Accuracy::exact));
  }
  std::string words(double level) {
    std::string all;
    for (const std::string& each : comfort_in_words(studio_, rig_, found(level), true))
      all += each + "\n";
    return all;
  }
  studio::Studio studio_ = support::analytic_studio();
  studio::Rig rig_;
};

TEST_F(ComfortOfALook, BurntSkinIsSaidWithItsRemedy) {
  EXPECT_LT(found(0.1).burnt_skin, 0.01);
  studio_.fixtures[0].output = core::Candela{30000};
  EXPECT_GT(found(1).burnt_skin, 0.1);
  EXPECT_NE(words(1).find("close the aperture ⅓ stop"), std::string::npos) << words(1);
}

TEST_F(ComfortOfALook, EyesWithoutCatchLightAreSaid) {
  EXPECT_TRUE(found(0.3).right_eye);
  studio_.fixtures[0] = support::fixed_lamp("rim", studio::Role::back, {0.3, 1.2, 2.0}, 3000);
  const Comfort comfort = found(0.3);
  EXPECT_FALSE(comfort.right_eye || comfort.left_eye);
  EXPECT_NE(words(0.3).find("the eyes have no catch-light"), std::string::npos) << words(0.3);
}

TEST_F(ComfortOfALook, ABackgroundThatOutshinesTheFaceIsSaid) {
  EXPECT_LT(found(0.3).background_over_face, 1);
  studio_.fixtures[0] = support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 800);
  EXPECT_GT(found(1).background_over_face, 1);
  EXPECT_NE(words(1).find("background is"), std::string::npos) << words(1);
}

TEST_F(ComfortOfALook, ABurntBackgroundIsSaidInsteadOfABrightOne) {
  studio_.fixtures[0] = support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 30000);
  EXPECT_GT(found(1).burnt_background, 0.05);
  EXPECT_NE(words(1).find("of the background is burnt out"), std::string::npos) << words(1);
  EXPECT_EQ(words(1).find("background is 1"), std::string::npos) << words(1);
}

TEST_F(ComfortOfALook, OneEyeWithoutCatchLightIsSaidAsOne) {
  Comfort comfort = found(0.3);
  comfort.left_eye = false;
  std::string said;
  for (const std::string& each : comfort_in_words(studio_, rig_, comfort, false)) said += each;
  EXPECT_NE(said.find("one eye has no catch-light"), std::string::npos) << said;
}

TEST_F(ComfortOfALook, ALampOnTheCameraShowsInGlassesUntilItIsRaised) {
  const Vec3 camera = studio_.main_camera().at;
  studio_.fixtures[0] =
      support::stand_lamp("key", studio::Role::key, {0, core::radians(-14), 1.8}, 3000);
  (void)camera;
  rig_ = studio::placed_rig(studio_);
  rig_.states[0].set(core::Dof::intensity, 0.5);
  for (double elevation = -40; elevation < 20 && glare_share(studio_, rig_) == 0; elevation += 1)
    rig_.states[0].set(core::Dof::elevation, core::radians(elevation));
  ASSERT_EQ(glare_share(studio_, rig_), 1);
  Comfort comfort;
  comfort.glare = {0};
  comfort.right_eye = comfort.left_eye = true;
  const auto said = comfort_in_words(studio_, rig_, comfort, true);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("key shows in the glasses: raise it to"), std::string::npos) << said[0];
  EXPECT_TRUE(comfort_in_words(studio_, rig_, comfort, false).empty());
}

/// The shipped sitter before a wall, traced.
class ShadowOnTheWall : public testing::Test {
 protected:
  ShadowOnTheWall()
      : world_(clock_, network_, folder_.path()),
        studio_(studio::load_studio(world_.world.config_folder / "studios/portrait.yaml",
                                    studio::Folders{world_.world.config_folder})
                    ->studio) {}
  /// `wall`: metres behind the sitter; the key alone, placed in degrees.
  Comfort found(double wall, double azimuth, double elevation, double wall_light = 0) {
    studio_.background.front().through.y = wall;
    const auto twin = geometric_layers(studio_, {});
    rig_ = studio::placed_rig(studio_);
    for (core::FixtureState& state : rig_.states) state.set(core::Dof::intensity, 0);
    core::FixtureState& key = rig_.states[*studio_.fixture_index("key")];
    key.set(core::Dof::azimuth, core::radians(azimuth));
    key.set(core::Dof::elevation, core::radians(elevation));
    key.set(core::Dof::intensity, 0.2);
    rig_.states[*studio_.fixture_index("wall")].set(core::Dof::intensity, wall_light);
    const Layers& layers = (*twin)->at({64, 64});
    return comfort_of(studio_, layers, rig_, predicted(studio_, layers, rig_, Accuracy::exact));
  }
  support::TemporaryFolder folder_;
  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::FakeWorld world_;
  studio::Studio studio_;
  studio::Rig rig_;
};

TEST_F(ShadowOnTheWall, IsSaidOfTheLampThatThrowsItWithItsRemedy) {
  const Comfort comfort = found(0.6, -15, 8);
  ASSERT_EQ(comfort.shadows.size(), 1u);
  EXPECT_EQ(studio_.fixtures[comfort.shadows.front().fixture].name, "key");
  EXPECT_GT(comfort.shadows.front().share, 0.05);
  EXPECT_GT(comfort.shadows.front().stops, 1);
  std::string said;
  for (const std::string& each : comfort_in_words(studio_, rig_, comfort, false)) said += each;
  EXPECT_NE(said.find("key throws the subject's shadow on the background"), std::string::npos)
      << said;
  EXPECT_NE(said.find("move the subject further from it"), std::string::npos) << said;
}

TEST_F(ShadowOnTheWall, OfAHighKeyFarFromTheWallFallsOutsideTheFrame) {
  EXPECT_TRUE(found(2.0, -50, 50).shadows.empty());
}

TEST_F(ShadowOnTheWall, IsPalerWhereTheWallHasALightOfItsOwn) {
  const auto deepest = [](const Comfort& comfort) {
    return comfort.shadows.empty() ? 0 : comfort.shadows.front().stops;
  };
  EXPECT_LT(deepest(found(1.2, -12, 8, 1)), deepest(found(1.2, -12, 8)) - 0.3);
}

}  // namespace
}  // namespace chiaro::design
