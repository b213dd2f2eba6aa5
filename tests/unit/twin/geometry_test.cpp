// SPDX-License-Identifier: Apache-2.0
// Subjects on their mark, planes, the aim, lamps in their poses.
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/twin/head.h"
#include "controller/twin/scene.h"
#include "tests/support/meshes.h"

namespace chiaro::twin {
namespace {

using core::Dof;
using core::Vec3;
using testing::HasSubstr;

class GeometryOf : public testing::Test {
 protected:
  GeometryOf() : studio(support::ball_studio(folder.path(), 2)) {}
  std::shared_ptr<const Geometry> build() const {
    const auto geometry = build_geometry(studio, {});
    EXPECT_TRUE(geometry) << core::to_string(geometry.problems());
    return geometry ? *geometry : nullptr;
  }
  /// An arrow: a thin box from the origin to +X 1 m, tip down the axis, in file `arrow` + kind.
  void arrow(const std::string& kind) {
    const auto file = folder.path() / ("arrow" + kind);
    std::ofstream out(file);
    if (kind == ".obj")
      out << "v 0 0 0\nv 0 1 0\nv 0 0 2\nf 1 2 3\n";  // 1 up (y), 2 to the front (z)
    else
      out << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int "
             "vertex_indices\nend_header\n"
             "0 0 0\n0 0 1\n0 -2 0\n3 0 1 2\n";  // 1 up (z), 2 to the front (-y)
    studio.subjects.front().mesh = file;
    studio.subjects.front().at = {0, 0, 0};
  }
  support::Folder folder;
  studio::Studio studio;
};

TEST_F(GeometryOf, SubjectStandsOnItsMarkAtItsHeight) {
  studio.subjects.front().height = 0.8;
  studio.subjects.front().at = {0.3, -0.2, 1.0};
  const auto geometry = build();
  EXPECT_NEAR(geometry->subject_bounds.least.z, 1.0, 1e-6);
  EXPECT_NEAR(geometry->subject_bounds.most.z, 1.8, 1e-6);
  EXPECT_NEAR(geometry->subject_bounds.centre().x, 0.3, 1e-6);
  EXPECT_NEAR(geometry->subject_bounds.centre().y, -0.2, 1e-6);
}

TEST_F(GeometryOf, FrontTurnsToTheCameraWhateverTheFormatsAxes) {
  for (const std::string kind : {".obj", ".ply"}) {
    arrow(kind);
    const auto box = build()->subject_bounds;
    EXPECT_NEAR(box.extent().z, 1, 1e-6) << kind;  // up is up
    EXPECT_NEAR(box.extent().y, 2, 1e-6) << kind;  // the front lies along the camera's direction
    EXPECT_NEAR(box.extent().x, 0, 1e-6) << kind;
  }
}

TEST_F(GeometryOf, FacingTurnsTowardsTheCamerasRight) {
  arrow(".ply");
  studio.subjects.front().facing = core::radians(90);
  const auto geometry = build();
  // The tip (2 m in front, low) is now at +X, the tall end (z 1) at -X.
  const Mesh& mesh = geometry->meshes.front();
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh.positions[3 * i + 2] > 0.5f) {
      EXPECT_NEAR(mesh.positions[3 * i], -1, 1e-5);
    }
}

TEST_F(GeometryOf, AimIsTheHeadOfAFigureWithANeck) {
  // Head, neck and shoulders as three balls in one mesh.
  Mesh figure = support::icosphere({0, 0, 1.6}, 0.12, 3);
  for (const auto& [z, r] : {std::pair{1.43, 0.05}, {1.15, 0.26}}) {
    const Mesh part = support::icosphere({0, 0, z}, r, 3);
    figure.positions.pop_back();
    const auto first = static_cast<std::uint32_t>(figure.positions.size() / 3);
    figure.positions.insert(figure.positions.end(), part.positions.begin(), part.positions.end());
    for (const std::uint32_t i : part.indices) figure.indices.push_back(first + i);
  }
  const Vec3 head = head_centre(figure, {1, 0, 0});
  EXPECT_NEAR(head.z, 1.6, 0.03);
  // A ball has no neck: its middle.
  EXPECT_NEAR(head_centre(support::icosphere({0, 0, 1}, 0.3, 3), {1, 0, 0}).z, 1, 1e-3);
}

TEST_F(GeometryOf, ShippedBustLooksOutOfEyesAtTheirHeight) {
  studio.subjects.front().mesh = std::filesystem::path(CHIARO_SOURCE) / "config/subjects/bust.ply";
  studio.subjects.front().stand_in = true;
  studio.subjects.front().eye_height = 1.55;
  const auto geometry = build();
  EXPECT_NEAR(geometry->subject_bounds.least.z, 1.55 - 0.4992, 2e-3);  // bust.yaml: eye_height
  EXPECT_NEAR(geometry->aim.origin.z, 1.55, 0.05);
  EXPECT_NEAR(geometry->aim.origin.x, 0, 0.02);
}

TEST_F(GeometryOf, WallStandsOnItsPointAndFloorLiesAboutIt) {
  studio.background.push_back({"floor", {0, 0, 0}, {0, 0, 1}, 8, 6, {}, {}});
  const auto geometry = build();
  const core::Box3 wall = bounds_of(geometry->meshes[1]), floor = bounds_of(geometry->meshes[2]);
  EXPECT_NEAR(wall.least.z, 0, 1e-6);
  EXPECT_NEAR(wall.most.z, 4, 1e-6);
  EXPECT_NEAR(wall.most.x, 3, 1e-6);
  EXPECT_NEAR(floor.most.x, 4, 1e-6);
  EXPECT_NEAR(floor.most.y, 3, 1e-6);
  EXPECT_FALSE(geometry->meshes[1].subject);
}

TEST_F(GeometryOf, EveryBadSubjectIsReportedAtOnce) {
  studio.subjects.push_back(studio.subjects.front());
  studio.subjects[0].mesh = folder.path() / "gone.ply";
  studio.subjects[1].mesh = folder.path() / "lost.obj";
  const auto geometry = build_geometry(studio, {});
  ASSERT_FALSE(geometry);
  EXPECT_THAT(core::to_string(geometry.problems()), HasSubstr("gone.ply"));
  EXPECT_THAT(core::to_string(geometry.problems()), HasSubstr("lost.obj"));
}

TEST_F(GeometryOf, MeshInMillimetresIsRefusedWithTheRemedy) {
  support::write_ply(folder.path() / "mm.ply", support::icosphere({}, 900, 1));
  studio.subjects.front().mesh = folder.path() / "mm.ply";
  const auto geometry = build_geometry(studio, {});
  ASSERT_FALSE(geometry);
  EXPECT_THAT(core::to_string(geometry.problems()), HasSubstr("give its height"));
}

TEST_F(GeometryOf, StandPutsTheLampWhereItsStateSaysAimedAtTheSubject) {
  const auto geometry = build();
  core::FixtureState state;
  state.set(Dof::azimuth, core::radians(90));
  state.set(Dof::elevation, 0);
  state.set(Dof::distance, 2);
  const Pose right = pose(studio.fixtures[0], state, geometry->aim);
  EXPECT_NEAR(right.position.x, geometry->aim.origin.x + 2, 1e-9);  // the camera's right
  EXPECT_NEAR(right.direction.x, -1, 1e-9);
  state.set(Dof::azimuth, 0);
  EXPECT_LT(pose(studio.fixtures[0], state, geometry->aim).position.y, -1.9);
}

TEST_F(GeometryOf, LightSpansItsFaceAtRightAngles) {
  const auto geometry = build();
  const Light soft = light(studio.fixtures[1], {}, geometry->aim, {5600});
  EXPECT_NEAR(dot(soft.right, soft.up), 0, 1e-12);
  EXPECT_NEAR(dot(soft.right, soft.direction), 0, 1e-12);
  EXPECT_NEAR(soft.right.z, 0, 1e-12);  // hangs level
  EXPECT_GT(soft.up.z, 0);
}

TEST_F(GeometryOf, SceneCarriesLevelsAmbientAndExposure) {
  studio.ambient = studio::Ambient{{50}, {5600}, {}};
  studio::Rig rig = studio::placed_rig(studio);
  rig.states[0].set(Dof::intensity, 0.25);
  const Scene scene = lit_by(studio, build(), rig);
  EXPECT_EQ(scene.levels[0], 0.25);
  EXPECT_NEAR(core::luminance(scene.ambient_irradiance), 50, 1e-6);
  EXPECT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[2].fixture, 2u);
}

}  // namespace
}  // namespace chiaro::twin
