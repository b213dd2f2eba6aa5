// SPDX-License-Identifier: Apache-2.0
// The geometric twin as the design engine meets it.
#include "controller/design/geometric_layers.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "tests/support/meshes.h"

namespace chiaro::design {
namespace {

using core::Dof;

class Geometric : public testing::Test {
 protected:
  Geometric() : studio(support::ball_studio(folder.path(), 3)) {}
  std::unique_ptr<LayersSource> source(GeometricOptions options = {}) const {
    auto made = geometric_layers(studio, options);
    EXPECT_TRUE(made) << core::to_string(made.problems());
    return std::move(*made);
  }
  static core::FixtureState state(double azimuth, double elevation, double distance) {
    core::FixtureState out;
    out.set(Dof::azimuth, core::radians(azimuth));
    out.set(Dof::elevation, core::radians(elevation));
    out.set(Dof::distance, distance);
    return out;
  }
  static double sum(const core::Plane& plane) {
    double total = 0;
    for (const float v : plane.values) total += v;
    return total;
  }
  support::Folder folder;
  studio::Studio studio;
};

TEST_F(Geometric, LuminanceIsThatOfTheColourLayers) {
  const auto twin = source();
  const Layers& layers = twin->at({64, 64});
  for (const Accuracy accuracy : {Accuracy::cached, Accuracy::exact}) {
    core::Plane y({64, 64});
    core::Layer colour;
    layers.luminance(1, state(30, 20, 1.5), accuracy, y);
    layers.colour(1, state(30, 20, 1.5), accuracy, colour);
    const core::Plane diffuse = core::luminance(colour.diffuse);
    const core::Plane specular = core::luminance(colour.specular);
    for (std::size_t i = 0; i < y.values.size(); ++i)
      EXPECT_NEAR(y.values[i], diffuse.values[i] + specular.values[i], 1e-5);
    EXPECT_GT(sum(specular), 0);
  }
}

TEST_F(Geometric, StateWithoutPlaceMeansTheMountsOwn) {
  const auto twin = source();
  const Layers& layers = twin->at({32, 32});
  core::Plane own({32, 32}), said({32, 32});
  layers.luminance(0, {}, Accuracy::cached, own);
  layers.luminance(0, state(-45, 35, 1.6), Accuracy::cached, said);
  for (std::size_t i = 0; i < own.values.size(); ++i)
    EXPECT_NEAR(own.values[i], said.values[i], 1e-6);
}

TEST_F(Geometric, IntensityIsNotInTheLayer) {
  const auto twin = source();
  core::Plane full({32, 32}), dim({32, 32});
  core::FixtureState where = state(-45, 35, 1.6);
  twin->at({32, 32}).luminance(0, where, Accuracy::cached, full);
  where.set(Dof::intensity, 0.1);
  twin->at({32, 32}).luminance(0, where, Accuracy::cached, dim);
  EXPECT_EQ(full, dim);
}

TEST_F(Geometric, UncontrolledPracticalsAndAmbientAreThereAlready) {
  studio.ambient = studio::Ambient{{40}, {5600}, {}};
  studio.fixtures[2].controlled = false;
  const auto with = source();
  studio.fixtures[2].controlled = true;
  const auto without = source();
  EXPECT_GT(sum(core::luminance(with->at({32, 32}).ambient())),
            1.05 * sum(core::luminance(without->at({32, 32}).ambient())));
  EXPECT_GT(sum(core::luminance(without->at({32, 32}).ambient())), 0);
}

TEST_F(Geometric, ReferenceTracesEveryTimeAndRemembersNothing) {
  GeometricOptions options;
  options.reference = true;
  const auto twin = source(options);
  const Layers& layers = twin->at({32, 32});
  core::Plane out({32, 32});
  const render::Work before = render::work_done();
  layers.luminance(0, {}, Accuracy::cached, out);
  const render::Work once = render::work_done();
  layers.luminance(0, {}, Accuracy::cached, out);
  const render::Work twice = render::work_done();
  EXPECT_GT(once.shadow_rays, before.shadow_rays);
  EXPECT_EQ(twice.shadow_rays - once.shadow_rays, once.shadow_rays - before.shadow_rays);
  EXPECT_EQ(twice.nodes, before.nodes);
}

TEST_F(Geometric, ThreadsDoNotChangeTheAnswer) {
  GeometricOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const auto a = source(one), b = source(two);
  for (const Accuracy accuracy : {Accuracy::cached, Accuracy::exact})
    for (const std::size_t fixture : {0u, 1u, 2u}) {
      core::Plane x({48, 48}), y({48, 48});
      a->at({48, 48}).luminance(fixture, {}, accuracy, x);
      b->at({48, 48}).luminance(fixture, {}, accuracy, y);
      EXPECT_EQ(x, y);
    }
}

TEST_F(Geometric, ManyThreadsMayAskAtOnceForSizesAndLayers) {
  const auto twin = source();
  std::vector<double> sums(6);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < sums.size(); ++k)
    threads.emplace_back([&, k] {
      const core::Size size = k % 2 == 0 ? core::Size{32, 32} : core::Size{48, 48};
      core::Plane out(size);
      twin->at(size).luminance(1, state(20, 10, 1.8), Accuracy::cached, out);
      twin->at(size).luminance(1, state(20, 10, 1.8), Accuracy::exact, out);
      sums[k] = sum(out);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 2; k < sums.size(); ++k) EXPECT_EQ(sums[k], sums[k % 2]);
}

// [I-6, I-7]
TEST_F(Geometric, GeometryShowsTheSubjectBeforeTheBackground) {
  const auto twin = source();
  const core::GeometryPlanes& planes = *twin->at({64, 64}).geometry();
  EXPECT_EQ(planes.subject.at(32, 32), 1);
  EXPECT_EQ(planes.subject.at(1, 1), 0);
  EXPECT_LT(planes.depth.at(32, 32), planes.depth.at(1, 1));
}

TEST_F(Geometric, ProblemsOfTheMeshComeBack) {
  studio.subjects.front().mesh = folder.path() / "gone.ply";
  const auto made = geometric_layers(studio, {});
  ASSERT_FALSE(made);
  EXPECT_THAT(core::to_string(made.problems()), testing::HasSubstr("gone.ply"));
}

}  // namespace
}  // namespace chiaro::design
