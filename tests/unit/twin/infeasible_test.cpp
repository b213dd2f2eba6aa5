// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/twin/scene.h"
#include "tests/support/meshes.h"

namespace chiaro::twin {
namespace {

using core::Dof;
using testing::HasSubstr;
using testing::IsEmpty;

class Infeasible : public testing::Test {
 protected:
  Infeasible() : studio(support::ball_studio(folder.path(), 2)) {
    studio.background.push_back({"floor", {0, 0, 0}, {0, 0, 1}, 8, 8, {}, {}});
    studio.ceiling = 3;
    geometry = *build_geometry(studio, {});
    rig = studio::placed_rig(studio);
  }
  std::string at(double azimuth, double elevation, double distance, std::size_t fixture = 0) {
    rig.states[fixture].set(Dof::azimuth, core::radians(azimuth));
    rig.states[fixture].set(Dof::elevation, core::radians(elevation));
    rig.states[fixture].set(Dof::distance, distance);
    return infeasible(studio, *geometry, rig, fixture);
  }
  support::Folder folder;
  studio::Studio studio;
  std::shared_ptr<const Geometry> geometry;
  studio::Rig rig;
};

TEST_F(Infeasible, UsualKeyPlaceIsFine) { EXPECT_THAT(at(-45, 35, 1.6), IsEmpty()); }
TEST_F(Infeasible, TooNearTheSitter) {
  EXPECT_THAT(at(-45, 10, 0.6), HasSubstr("from the sitter"));
}
TEST_F(Infeasible, InThePicture) {
  EXPECT_THAT(at(160, 10, 1.0), HasSubstr("show in the picture of camera main"));
}
TEST_F(Infeasible, OnlyTheStandInThePicture) {
  // Lamp above the picture, its pole runs down through it.
  EXPECT_THAT(at(180, 55, 1.1), HasSubstr("show in the picture"));
}
TEST_F(Infeasible, ALampHighInFrontHangsOnABoom) {
  EXPECT_THAT(at(0, 50, 1.6), IsEmpty());
  EXPECT_THAT(at(0, 20, 1.6), HasSubstr("show in the picture"));
}
TEST_F(Infeasible, AllowedInThePictureWhenTheFileSaysSo) {
  studio.cameras.front().lamps_may_show = true;
  EXPECT_THAT(at(160, 10, 1.0), IsEmpty());
}
TEST_F(Infeasible, BetweenCameraAndSubject) {
  studio.cameras.front().lamps_may_show = true;
  EXPECT_THAT(at(0, 0, 1.2), HasSubstr("between camera main and the subject"));
}
TEST_F(Infeasible, ThroughTheCeiling) { EXPECT_THAT(at(-60, 70, 2.0), HasSubstr("ceiling")); }
TEST_F(Infeasible, ThroughTheFloor) { EXPECT_THAT(at(-70, -45, 2.0), HasSubstr("floor")); }
TEST_F(Infeasible, BehindTheWall) { EXPECT_THAT(at(120, 10, 2.9), HasSubstr("wall")); }
TEST_F(Infeasible, InTheWayOfAnotherLamp) {
  at(50, 20, 1.8, 1);
  EXPECT_THAT(at(50, 22, 1.8), HasSubstr("in the way of fill"));
}
TEST_F(Infeasible, SoftboxCountsWithItsWholeFace) {
  EXPECT_THAT(at(-70, -30, 2.0), IsEmpty());
  studio.fixtures[0].modifiers = {{"softbox", 0.9, 1.4, 1.3}};
  EXPECT_THAT(at(-70, -30, 2.0), HasSubstr("floor"));
}
TEST_F(Infeasible, LampThatCannotMoveIsNotJudged) {
  EXPECT_THAT(infeasible(studio, *geometry, rig, 2), IsEmpty());
}
TEST_F(Infeasible, FreeLampOfTheThesisHasNoBody) {
  studio.fixtures[0].mount = studio::VirtualMount{};
  EXPECT_THAT(at(0, 0, 1.2), IsEmpty());
}

}  // namespace
}  // namespace chiaro::twin
