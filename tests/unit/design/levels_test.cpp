// SPDX-License-Identifier: Apache-2.0
#include "controller/design/levels.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/measure/gram.h"
#include "tests/support/analytic_layers.h"
#include "tests/support/rigs.h"

namespace chiaro::design {
namespace {

constexpr core::Size kSize{32, 32};

/// Three fixed lamps, each one's luminance column.
class Levels3 : public testing::Test {
 protected:
  Levels3() : studio_(support::analytic_studio()) {
    studio_.fixtures = {support::fixed_lamp("key", studio::Role::key, {-1.2, -1.2, 2.2}, 6000),
                        support::fixed_lamp("fill", studio::Role::fill, {1.4, -1.6, 1.5}, 3000),
                        support::fixed_lamp("wall", studio::Role::background, {0, 0.9, 0.2}, 500)};
    twin_ = std::make_unique<support::AnalyticSource>(studio_);
    const Layers& layers = twin_->at(kSize);
    planes_.assign(3, core::Plane(kSize));
    offset_ = core::Plane(kSize);
    for (std::size_t k = 0; k < 3; ++k) {
      layers.luminance(k, {}, Accuracy::exact, planes_[k]);
      columns_.planes.push_back(&planes_[k]);
      columns_.bounds.push_back({0, 1});
    }
    columns_.offset = &offset_;
  }

  Target target(std::array<double, 3> levels, Objective objective) {
    studio::Rig rig = studio::placed_rig(studio_);
    for (std::size_t k = 0; k < 3; ++k) rig.states[k].set(core::Dof::intensity, levels[k]);
    return target_of(support::like(support::photographed(studio_, *twin_, rig, kSize), objective),
                     kSize);
  }

  studio::Studio studio_;
  std::unique_ptr<support::AnalyticSource> twin_;
  std::vector<core::Plane> planes_;
  core::Plane offset_;
  Columns columns_;
};

TEST_F(Levels3, WaveletSolutionIsTheLevelsThatMadeThePicture) {
  const Target wanted = target({0.5, 0.3, 0.4}, Objective::wavelet);
  const auto map = measure::flat_pixel_map(kSize);
  const auto levels = level_solver(wanted, map)->solve(columns_, Effort::quick);
  EXPECT_NEAR(levels.values[0], 0.5, 0.01);
  EXPECT_NEAR(levels.values[1], 0.3, 0.01);
  EXPECT_NEAR(levels.values[2], 0.4, 0.01);
  EXPECT_LT(levels.cost, 0.5);
}

TEST_F(Levels3, WaveletSolutionBeatsEveryPointOfAGridAndItsNeighbours) {
  // A picture that no levels give: the three lamps at other places.
  for (auto& fixture : studio_.fixtures) std::get<studio::FixedMount>(fixture.mount).at.x += 0.9;
  const Target wanted = target({0.7, 0.5, 0.9}, Objective::wavelet);
  const auto map = measure::flat_pixel_map(kSize);
  const auto solver = level_solver(wanted, map);
  const auto best = solver->solve(columns_, Effort::thorough);
  for (int a = 0; a <= 16; ++a)
    for (int b = 0; b <= 16; ++b)
      for (int c = 0; c <= 16; ++c) {
        const std::vector<double> levels{a / 16.0, b / 16.0, c / 16.0};
        EXPECT_GE(solver->cost(columns_, levels), best.cost * (1 - 1e-6));
      }
  for (std::size_t k = 0; k < 3; ++k)
    for (const double nudge : {-0.01, 0.01}) {
      auto levels = best.values;
      levels[k] = columns_.bounds[k].clamp(levels[k] + nudge);
      EXPECT_GE(solver->cost(columns_, levels), best.cost * (1 - 1e-5));
    }
}

TEST_F(Levels3, QuickSolutionIsNearTheThoroughOne) {
  for (auto& fixture : studio_.fixtures) std::get<studio::FixedMount>(fixture.mount).at.x += 0.5;
  const Target wanted = target({0.7, 0.5, 0.9}, Objective::wavelet);
  const auto map = measure::flat_pixel_map(kSize);
  const auto solver = level_solver(wanted, map);
  EXPECT_LT(solver->solve(columns_, Effort::quick).cost,
            1.01 * solver->solve(columns_, Effort::thorough).cost);
}

TEST_F(Levels3, ClippedExemplarPixelsCostNothingWhenOursAreAtOrAboveThem) {
  Target wanted = target({1, 0.3, 0.4}, Objective::wavelet);
  // Everything in the exemplar is burnt out: any picture that clips everywhere is perfect.
  for (auto* plane : {&wanted.colour.red, &wanted.colour.green, &wanted.colour.blue})
    std::fill(plane->values.begin(), plane->values.end(), 1.0f);
  ExampleGoal white = support::like(wanted.colour);
  const Target clipped = target_of(white, kSize);
  const auto map = measure::flat_pixel_map(kSize);
  core::Plane bright(kSize, 1.7f);
  Columns one;
  one.planes = {&bright};
  one.offset = &offset_;
  one.bounds = {{0, 10}};
  const auto solver = level_solver(clipped, map);
  const double level_at_clip = 1 / 1.7;
  EXPECT_NEAR(solver->cost(one, std::vector<double>{level_at_clip}), 0, 1e-3);
  EXPECT_NEAR(solver->cost(one, std::vector<double>{5}), 0, 1e-6);
  EXPECT_GT(solver->cost(one, std::vector<double>{0.5 * level_at_clip}), 10);
}

TEST_F(Levels3, PerceptualSolutionComesNearToTheComponentsOfItsPicture) {
  const Target wanted = target({0.5, 0.2, 0.3}, Objective::perceptual);
  const auto map = measure::flat_pixel_map(kSize);
  const auto solver = level_solver(wanted, map);
  const auto found = solver->solve(columns_, Effort::thorough);
  EXPECT_LE(found.cost, solver->cost(columns_, std::vector<double>{0.5, 0.2, 0.3}) + 0.05);
  const auto quick = solver->solve(columns_, Effort::quick);
  EXPECT_LE(found.cost, quick.cost);
}

TEST_F(Levels3, NoLampsAtAllIsNoCrime) {
  Columns none;
  none.offset = &offset_;
  const auto map = measure::flat_pixel_map(kSize);
  for (const Objective objective : {Objective::wavelet, Objective::perceptual}) {
    const Target wanted = target({0.5, 0.2, 0.3}, objective);
    EXPECT_TRUE(level_solver(wanted, map)->solve(none, Effort::quick).values.empty());
  }
}

TEST_F(Levels3, TheGramFormsSlopeIsWhatFiniteDifferencesOfThePicturesSay) {
  const Target wanted = target({0.5, 0.3, 0.4}, Objective::wavelet);
  const auto form = measure::haar_form(columns_.planes, *columns_.offset, wanted.luminance);
  const std::vector<double> at{0.2, 0.6, 0.5};
  const auto squared = [&](std::vector<double> levels) {
    core::Plane picture(kSize);
    mix(columns_, levels, picture);
    const double far =
        measure::haar_distance(measure::haar_spectrum(picture, kSize.width),
                               measure::haar_spectrum(wanted.luminance, kSize.width));
    return far * far;
  };
  EXPECT_NEAR(form.at(at), squared(at), 1e-4 * squared(at));
  for (std::size_t k = 0; k < 3; ++k) {
    double slope = -2 * form.q_vector[k];
    for (std::size_t j = 0; j < 3; ++j) slope += 2 * form.q_matrix[3 * k + j] * at[j];
    const double step = 0.02;  // the form is quadratic: central differences have no error of step
    auto up = at, down = at;
    up[k] += step, down[k] -= step;
    const double measured = (squared(up) - squared(down)) / (2 * step);
    EXPECT_NEAR(slope, measured, 2e-3 * std::abs(measured)) << k;
  }
}

}  // namespace
}  // namespace chiaro::design
