// SPDX-License-Identifier: Apache-2.0
// Geometry worked by hand.
#include "controller/design/comfort.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/design/colours.h"
#include "tests/support/analytic_layers.h"
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

}  // namespace
}  // namespace chiaro::design
