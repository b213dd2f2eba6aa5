// SPDX-License-Identifier: Apache-2.0
#include "controller/render/visibility_cache.h"

#include <cmath>
#include <gtest/gtest.h>
#include <thread>

#include "controller/render/samples.h"
#include "tests/support/meshes.h"

namespace chiaro::render {
namespace {

using core::Dof;

class Cache : public testing::Test {
 protected:
  Cache() : studio(support::ball_studio(folder.path(), 3)) {
    const auto geometry = twin::build_geometry(studio, {});
    view = see(std::make_shared<const Tracer>(*geometry), studio.main_camera(), {96, 96});
  }
  core::FixtureState state(double azimuth, double elevation, double distance) const {
    core::FixtureState out;
    out.set(Dof::azimuth, core::radians(azimuth));
    out.set(Dof::elevation, core::radians(elevation));
    out.set(Dof::distance, distance);
    return out;
  }
  core::Plane seen(const VisibilityCache& cache, std::size_t fixture,
                   const core::FixtureState& where) const {
    core::Plane out;
    visibility(view, *cache.at(fixture, where), out);
    return out;
  }
  core::Plane lit(const Visible& visible, std::size_t fixture,
                  const core::FixtureState& where) const {
    core::Plane out;
    luminance(view,
              twin::light(studio.fixtures[fixture], where, view.tracer->geometry().aim, {5600}),
              1e-3, &visible, out);
    return out;
  }

  support::Folder folder;
  studio::Studio studio;
  View view;
};

TEST_F(Cache, AnswersTheSameWhateverWasAskedBefore) {
  const VisibilityCache fresh(view, studio, 64u << 20), used(view, studio, 64u << 20);
  for (const double azimuth : {60.0, -70.0, 11.0, 10.0})
    for (const std::size_t fixture : {0u, 1u}) seen(used, fixture, state(azimuth, 20, 1.5));
  for (const std::size_t fixture : {0u, 1u, 2u})
    EXPECT_EQ(seen(fresh, fixture, state(-40, 33, 1.7)), seen(used, fixture, state(-40, 33, 1.7)));
}

TEST_F(Cache, AnswersTheSameWhenItMayKeepNothing) {
  const VisibilityCache large(view, studio, 64u << 20), tiny(view, studio, 1);
  for (const double azimuth : {-40.0, 30.0, -40.0})
    EXPECT_EQ(seen(large, 1, state(azimuth, 33, 1.7)), seen(tiny, 1, state(azimuth, 33, 1.7)));
  EXPECT_LT(tiny.bytes(), 20000u);
  EXPECT_GE(large.bytes(), 8 * 9000u);
}

TEST_F(Cache, TracesAPlaceOnceAndNeverAgain) {
  const VisibilityCache cache(view, studio, 64u << 20);
  const Work before = work_done();
  seen(cache, 0, state(-41, 33, 1.7));
  const Work filled = work_done();
  EXPECT_EQ(filled.nodes - before.nodes, 8u);
  EXPECT_EQ(filled.shadow_rays - before.shadow_rays, 8 * view.buffer.samples());
  seen(cache, 0, state(-41.1, 33.05, 1.699));
  EXPECT_EQ(work_done().shadow_rays, filled.shadow_rays);
}

TEST_F(Cache, AnswersThreadsThatAskAtOnceAlike) {
  const VisibilityCache cache(view, studio, 64u << 20), alone(view, studio, 64u << 20);
  std::vector<core::Plane> answers(4);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < answers.size(); ++k)
    threads.emplace_back([&, k] { answers[k] = seen(cache, k % 2, state(-20, 15, 2)); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < answers.size(); ++k)
    EXPECT_EQ(answers[k], seen(alone, k % 2, state(-20, 15, 2)));
}

TEST_F(Cache, AtAPlaceOfTheGridIsTheTracedAnswer) {
  const VisibilityCache cache(view, studio, 64u << 20);
  // The corner of the region is a place.
  const core::FixtureState corner = state(-80, -10, 1.2);
  const twin::Light light =
      twin::light(studio.fixtures[0], corner, view.tracer->geometry().aim, {5600});
  EXPECT_EQ(seen(cache, 0, corner), visibility(view, light, Shadows::hard));
}

TEST_F(Cache, BlendsWithoutJumpsBetweenPlaces) {
  const VisibilityCache cache(view, studio, 64u << 20);
  core::Plane last = seen(cache, 0, state(-45, 30, 1.5));
  for (double azimuth = -44.9; azimuth < -30; azimuth += 0.1) {
    const core::Plane next = seen(cache, 0, state(azimuth, 30, 1.5));
    double most = 0;
    for (std::size_t i = 0; i < next.values.size(); ++i)
      most = std::max<double>(most, std::abs(next.values[i] - last.values[i]));
    ASSERT_LE(most, 0.1 / 7 + 1e-3) << azimuth;
    last = next;
  }
}

TEST_F(Cache, LightsWithinAPercentOfTheTruthOnAverage) {
  const VisibilityCache cache(view, studio, 64u << 20);
  for (const std::size_t fixture : {0u, 1u})
    for (const double azimuth : {-63.0, -22.0, 8.0, 47.0}) {
      const core::FixtureState where = state(azimuth, 27, 1.62);
      const twin::Light light =
          twin::light(studio.fixtures[fixture], where, view.tracer->geometry().aim, {5600});
      const core::Plane cached = lit(*cache.at(fixture, where), fixture, where);
      const core::Plane exact = lit(Traced(view, light, kExact), fixture, where);
      double sum = 0, truth = 0, squares = 0, true_squares = 0;
      for (std::size_t i = 0; i < exact.values.size(); ++i) {
        sum += cached.values[i], truth += exact.values[i];
        squares += cached.values[i] * cached.values[i];
        true_squares += exact.values[i] * exact.values[i];
      }
      EXPECT_NEAR(sum / truth, 1, 0.01) << fixture << " at " << azimuth;
      EXPECT_NEAR(std::sqrt(squares / true_squares), 1, 0.01) << fixture << " at " << azimuth;
    }
}

TEST_F(Cache, FixedLampIsTracedExactly) {
  const VisibilityCache cache(view, studio, 64u << 20);
  const twin::Light light =
      twin::light(studio.fixtures[2], {}, view.tracer->geometry().aim, {5600});
  EXPECT_EQ(seen(cache, 2, {}), visibility(view, light, Shadows::soft));
}

}  // namespace
}  // namespace chiaro::render
