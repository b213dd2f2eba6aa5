// SPDX-License-Identifier: Apache-2.0
// Every formula of the measures against values worked out by hand; the arithmetic stands beside.
#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/colour.h"
#include "controller/measure/filters.h"
#include "controller/measure/gram.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

core::Plane plane(int width, int height, std::vector<float> values) {
  core::Plane out({width, height});
  out.values = std::move(values);
  return out;
}
core::Plane four(std::vector<float> values) { return plane(4, 4, std::move(values)); }

PixelMap map_of(int width, int height, const std::string& drawing) {
  // '.' background, 's' surface, 'e' edge; upper case 'W' is a wall: background that is something.
  core::Grid<PixelType> type({width, height});
  core::Grid<std::uint8_t> external({width, height}, 0);
  core::Grid<std::uint16_t> part({width, height}, 1);
  for (std::size_t i = 0; i < drawing.size(); ++i) {
    const char c = drawing[i];
    type.values[i] = c == 's'   ? PixelType::surface
                     : c == 'e' ? PixelType::edge
                                : PixelType::background;
    part.values[i] = c == '.' ? core::kNothing : c == 'W' ? std::uint16_t{2} : std::uint16_t{1};
  }
  return pixel_map_of(std::move(type), std::move(external), part);
}

TEST(LightnessGolden, KnowsTheAnchorsOfTheCieCurve) {
  // White: 116 * 1 - 16 = 100, x 2.55 = 255. Y = 0.1842: 116 * 0.56899 - 16 = 50.00, x 2.55.
  // Y = 0.005 (linear part): 903.2963 * 0.005 = 4.5165, x 2.55 = 11.517. 0.5: 116 * 0.7937 - 16 =
  // 76.069, x 2.55 = 193.977. Beyond white clips, below black counts as black.
  const core::Plane out = working_scalar(plane(7, 1, {0, 0.005f, 0.1842f, 0.5f, 1, 3, -1}));
  const double wanted[] = {0, 11.5170, 127.51, 193.977, 255, 255, 0};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(out.values[i], wanted[i], 0.01) << i;
}

// [I-14]
TEST(SobelGolden, AnswersOneForARampOfOneGreyLevelPerPixel) {
  // Columns 0 1 2 3. Inside: gx = (2-0) + 2 (2-0) + (2-0) = 8, gy = 0, |G| / 8 = 1.
  // At the left border 0 repeats: gx = 4 * (1 - 0) = 4, |G| / 8 = 0.5.
  const core::Plane g = sobel_magnitude(four({0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}));
  EXPECT_FLOAT_EQ(g.at(1, 1), 1);
  EXPECT_FLOAT_EQ(g.at(2, 2), 1);
  EXPECT_FLOAT_EQ(g.at(0, 1), 0.5f);
  EXPECT_FLOAT_EQ(g.at(3, 0), 0.5f);
}

TEST(SobelGolden, TakesTheLengthOfBothDirections) {
  // At (1, 1) of rows 0 0 0 / 0 0 8 / 0 8 8: gx = 1*0 + 2*8 + 1*(8-0) = 24, gy = 0 + 2*8 + 8 = 24;
  // sqrt(24^2 + 24^2) / 8 = 4.24264.
  const core::Plane g = sobel_magnitude(plane(3, 3, {0, 0, 0, 0, 0, 8, 0, 8, 8}));
  EXPECT_NEAR(g.at(1, 1), 4.24264, 1e-5);
}

// [I-15]
TEST(LaplacianGolden, IsZeroOnEveryRampAndTheHeightOfASpike) {
  // Ramp x + 2 y inside: the eight neighbours average the centre. A spike of 8 on 0: (8*8 - 0) / 8
  // = 8; beside it (0 - 8) / 8 = -1. As printed (two wrong signs) a flat 8 would answer 4, not 0.
  const core::Plane ramp = laplacian(four({0, 1, 2, 3, 2, 3, 4, 5, 4, 5, 6, 7, 6, 7, 8, 9}));
  EXPECT_FLOAT_EQ(ramp.at(1, 1), 0);
  EXPECT_FLOAT_EQ(ramp.at(2, 2), 0);
  const core::Plane spike = laplacian(plane(3, 3, {0, 0, 0, 0, 8, 0, 0, 0, 0}));
  EXPECT_FLOAT_EQ(spike.at(1, 1), 8);
  EXPECT_FLOAT_EQ(spike.at(0, 1), -1 - 0);  // border: the repeated column holds no spike
  EXPECT_FLOAT_EQ(laplacian(four(std::vector<float>(16, 8))).at(1, 1), 0);
}

const std::vector<float> kPicture{10, 10, 50, 50,  //
                                  10, 10, 50, 50,  //
                                  10, 10, 90, 90,  //
                                  10, 10, 90, 90};

// [I-17, I-18]
TEST(ComponentsGolden, MeanAndDeviationOverAllPixelsOfAFlatMap) {
  // Mean = (8*10 + 4*50 + 4*90) / 16 = 640 / 16 = 40. Variance = (8*900 + 4*100 + 4*2500) / 16 =
  // 17600 / 16 = 1100, its root 33.16625.
  const Components c = components(four(kPicture), flat_pixel_map({4, 4}));
  EXPECT_NEAR(c.mean, 40, 1e-6);
  EXPECT_NEAR(c.variance, 33.16625, 1e-5);
  EXPECT_EQ(c.edge, 0);
  EXPECT_EQ(c.contrast, 0);
}

// [I-19]
TEST(ComponentsGolden, HistogramHoldsShares) {
  const Components c = components(four(kPicture), flat_pixel_map({4, 4}));
  EXPECT_DOUBLE_EQ(c.histogram[10], 0.5);
  EXPECT_DOUBLE_EQ(c.histogram[50], 0.25);
  EXPECT_DOUBLE_EQ(c.histogram[90], 0.25);
  EXPECT_DOUBLE_EQ(c.histogram[0], 0);
}

TEST(ComponentsGolden, HistogramRoundsToTheNearestLevelAndSkipsBackground) {
  // 9.6 -> 10, 10.4 -> 10, 254.7 -> 255; the background's 7 does not count: shares of 3 pixels.
  const Components c = components(plane(4, 1, {9.6f, 10.4f, 254.7f, 7}), map_of(4, 1, "ses."));
  EXPECT_DOUBLE_EQ(c.histogram[10], 2.0 / 3);
  EXPECT_DOUBLE_EQ(c.histogram[255], 1.0 / 3);
  EXPECT_DOUBLE_EQ(c.histogram[7], 0);
}

// [I-16]
TEST(ComponentsGolden, GradientIsTheRootMeanSquareOverSurfacePixels) {
  // Columns 0 8 16 24 of 4 equal rows: |G| = 8 inside, 4 at both borders. Mean square = (2*64 +
  // 2*16) / 4 = 40, its root 6.32456. (A plain average would give 6.)
  const Components c = components(four({0, 8, 16, 24, 0, 8, 16, 24, 0, 8, 16, 24, 0, 8, 16, 24}),
                                  flat_pixel_map({4, 4}));
  EXPECT_NEAR(c.gradient, 6.32456, 1e-5);
}

// [I-23]
TEST(ComponentsGolden, ShadowPixelsWeighByHowMuchOfTheLampTheySee) {
  // Values 100 200, lit 1 and 0.5: mean = (100 + 0.5 * 200) / 1.5 = 133.3333;
  // variance = (1 * 33.333^2 + 0.5 * 66.667^2) / 1.5 = (1111.11 + 2222.22) / 1.5 = 2222.22,
  // root 47.14045.
  const core::Plane lit = plane(2, 1, {1, 0.5f});
  const Components c = components(plane(2, 1, {100, 200}), flat_pixel_map({2, 1}), &lit);
  EXPECT_NEAR(c.mean, 133.33333, 1e-4);
  EXPECT_NEAR(c.variance, 47.14045, 1e-4);
}

TEST(ComponentsGolden, EdgeIsTheShareOfEdgePixelsThatShow) {
  // Row 0 0 40 40 with edges at 1 and 3: at 1 gx = 4 * (40 - 0), / 8 = 20 > 8; at 3 (border
  // repeated) 4 * (40 - 40) = 0. One of two shows.
  const PixelMap map = map_of(4, 1, "sese");
  const core::Plane values = plane(4, 1, {0, 0, 40, 40});
  EXPECT_DOUBLE_EQ(components(values, map).edge, 0.5);
  // The hidden one lies in full shadow and weighs 2: 1 / (1 + 2).
  const core::Plane lit = plane(4, 1, {1, 1, 1, 0});
  EXPECT_NEAR(components(values, map, &lit).edge, 1.0 / 3, 1e-6);
}

// [I-20]
TEST(ComponentsGolden, ContrastIsMichelsonsOverRowsAndColumns) {
  // One row: parts mean (10 + 30) / 2 = 20 and (70 + 90) / 2 = 80 meet across one edge pixel whose
  // own value does not matter: |20 - 80| / 100 = 0.6.
  EXPECT_NEAR(components(plane(5, 1, {10, 30, 255, 70, 90}), map_of(5, 1, "ssess")).contrast, 0.6,
              1e-6);
  // The same upright: a horizontal boundary is seen too.
  EXPECT_NEAR(components(plane(1, 5, {10, 30, 255, 70, 90}), map_of(1, 5, "ssess")).contrast, 0.6,
              1e-6);
  // A black part: |0 - 80| / 80 = 1, not infinite. Two black parts: 0.
  EXPECT_NEAR(components(plane(3, 1, {0, 9, 80}), map_of(3, 1, "ses")).contrast, 1, 1e-6);
  EXPECT_NEAR(components(plane(3, 1, {0, 9, 0}), map_of(3, 1, "ses")).contrast, 0, 1e-6);
}

TEST(ComponentsGolden, ContrastCountsAVisibleWallButNotEmptiness) {
  // Subject 60 beside a wall of 20: |60 - 20| / 80 = 0.5; beside nothing: no meeting at all.
  EXPECT_NEAR(components(plane(3, 1, {20, 9, 60}), map_of(3, 1, "Wes")).contrast, 0.5, 1e-6);
  EXPECT_EQ(components(plane(3, 1, {20, 9, 60}), map_of(3, 1, ".es")).contrast, 0);
}

TEST(ComponentsGolden, ContrastAveragesOverAllMeetings) {
  // Row 1: 20 | 60 -> 0.5. Row 2: 20 | 20 -> 0. Columns hold one part each, so no meeting.
  // (0.5 + 0) / 2 = 0.25.
  EXPECT_NEAR(components(plane(3, 2, {20, 0, 60, 20, 0, 20}), map_of(3, 2, "sesses")).contrast,
              0.25, 1e-6);
}

// [I-31, I-32, I-34]
TEST(HaarGolden, FourByFourByHand) {
  // 2 x 2 squares of kPicture are constant (10, 50; 10, 90): every finest coefficient is 0.
  // Level 0: left mean 10, right (50 + 90) / 2 = 70: h = -60. Upper (10 + 50) / 2 = 30, lower
  // (10 + 90) / 2 = 50: v = -20. Mean 40.
  const HaarSpectrum s = haar_spectrum(four(kPicture), 4);
  ASSERT_EQ(s.horizontal.size(), 2u);
  EXPECT_FLOAT_EQ(s.horizontal[0][0], -60);
  EXPECT_FLOAT_EQ(s.vertical[0][0], -20);
  EXPECT_DOUBLE_EQ(s.mean, 40);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(s.horizontal[1][i], 0);
    EXPECT_FLOAT_EQ(s.vertical[1][i], 0);
  }
}

// [I-32]
TEST(HaarGolden, AntiDiagonalRampIsNotNothing) {
  // x - y: left half minus right = -2, upper minus lower = +2 at level 0; at level 1 -1 and +1.
  // Printed form: h + v = 0 everywhere. Ours: mean square per level 4 and 1, mean 0, three equal
  // weights: sqrt((0 + 4 + 1) / 3) = 1.29099.
  std::vector<float> v;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) v.push_back(static_cast<float>(x - y));
  const HaarSpectrum ramp = haar_spectrum(four(v), 4),
                     flat = haar_spectrum(four(std::vector<float>(16, 0)), 4);
  EXPECT_FLOAT_EQ(ramp.horizontal[0][0], -2);
  EXPECT_FLOAT_EQ(ramp.vertical[0][0], 2);
  EXPECT_FLOAT_EQ(ramp.horizontal[1][3], -1);
  EXPECT_FLOAT_EQ(ramp.vertical[1][3], 1);
  EXPECT_NEAR(haar_distance(ramp, flat), 1.2909944, 1e-6);
  EXPECT_EQ(haar_distance_as_printed(ramp, flat), 0);
}

TEST(HaarGolden, EightByEightOfOneBrightQuadrant) {
  // Upper left 4 x 4 = 80, the rest 0. Mean 20. Level 0: h = v = (80 + 0) / 2 - 0 = 40. Finer
  // levels 0. Distance from black: mean 400, level 0 (1600 + 1600) / 2 = 1600, levels 1 and 2
  // nothing: sqrt((400 + 1600) / 4) = 22.36068. As printed: one node of 21 differs, by 80: 80 / 21.
  core::Plane p({8, 8});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) p.at(x, y) = 80;
  const HaarSpectrum s = haar_spectrum(p, 8), black = haar_spectrum(core::Plane({8, 8}), 8);
  EXPECT_FLOAT_EQ(s.horizontal[0][0], 40);
  EXPECT_FLOAT_EQ(s.vertical[0][0], 40);
  EXPECT_NEAR(haar_distance(s, black), 22.36068, 1e-5);
  EXPECT_NEAR(haar_distance_as_printed(s, black), 80.0 / 21, 1e-6);
}

// [I-33]
TEST(HaarGolden, AConstantIsFeltByOursAndNotByThePrintedForm) {
  // Everything 10 brighter: the mean differs by 10, 1 of 3 equal weights: sqrt(100 / 3) = 5.7735.
  const HaarSpectrum a = haar_spectrum(four(kPicture), 4);
  std::vector<float> brighter = kPicture;
  for (float& v : brighter) v += 10;
  const HaarSpectrum b = haar_spectrum(four(brighter), 4);
  EXPECT_NEAR(haar_distance(a, b), 5.7735027, 1e-6);
  EXPECT_EQ(haar_distance_as_printed(a, b), 0);
}

// [I-29]
TEST(TermsGolden, ByExampleCosts) {
  Components now, goal;
  now.edge = 0.4, goal.edge = 0.7;          // |0.4 - 0.7| = 0.3
  now.mean = 100, goal.mean = 55;           // 45 / max(55, 200) = 0.225
  now.gradient = 5, goal.gradient = 20;     // 15 / 20 = 0.75
  now.variance = 60, goal.variance = 50;    // 10 / max(50, 77.5) = 0.129032
  now.contrast = 0.4, goal.contrast = 0.3;  // 0.1 / 0.4 = 0.25
  now.histogram[10] = 1, goal.histogram[10] = 0.5, goal.histogram[20] = 0.5;  // (0.5 + 0.5) / 2
  // 0.2*0.3 + 0.8*0.225 + 0.2*0.75 + 0.2*0.129032 + 0.8*0.5 + 0.2*0.25 = 0.8658065
  EXPECT_NEAR(perceptual_cost(now, targets_of(goal, true)), 0.8658065, 1e-6);
  // A 2D exemplar knows neither edge nor contrast: less 0.06 and 0.05.
  EXPECT_NEAR(perceptual_cost(now, targets_of(goal, false)), 0.7558065, 1e-6);
}

// [I-13]
TEST(TermsGolden, IdealCosts) {
  Components now;
  now.edge = 0.75;       // 1 - 0.75 = 0.25
  now.mean = 102;        // |102 - 127.5| / 127.5 = 0.2
  now.gradient = 15;     // |15 - 20| / 20 = 0.25
  now.variance = 46.5;   // |46.5 - 60| / max(60, 67.5) = 0.2
  now.contrast = 0.15;   // |0.15 - 0.3| / 0.3 = 0.5
  now.histogram[0] = 1;  // (255/256 + 255 * 1/256) / 2 = 0.99609375
  // 0.2*0.25 + 0.8*0.2 + 0.2*0.25 + 0.2*0.2 + 0.8*0.99609375 + 0.2*0.5 = 1.196875
  EXPECT_NEAR(ideal_cost(now, {.mean = 127.5, .variance = 60, .gradient = 20, .contrast = 0.3}),
              1.196875, 1e-9);
}

TEST(TermsGolden, EarthMoversDistanceGrowsWithTheWay) {
  std::array<double, 256> a{}, b{}, c{};
  a[10] = b[20] = c[61] = 1;
  // All of it moves 10 of 255 bins; 51 of 255 bins = 0.2. Half L1 is 1 both times.
  EXPECT_NEAR(histogram_distance(a, b, HistogramDistance::earth_mover), 10.0 / 255, 1e-12);
  EXPECT_NEAR(histogram_distance(a, c, HistogramDistance::earth_mover), 0.2, 1e-12);
  EXPECT_NEAR(histogram_distance(a, b), 1, 1e-12);
}

TEST(GramGolden, LeastSquaresFormByHand) {
  // Columns (1, 0), (1, 2); offset (0, 1), target (3, 3): rest = offset - target = (-3, -2).
  // Q = [1 1; 1 5]; q = -(column . rest) = (3, 3 + 4 = 7); c = 9 + 4 = 13.
  // At x = (1, 1): picture (2, 3) against (3, 3): 1.
  const core::Plane a = plane(2, 1, {1, 0}), b = plane(2, 1, {1, 2}), offset = plane(2, 1, {0, 1}),
                    target = plane(2, 1, {3, 3});
  const core::Plane* columns[] = {&a, &b};
  const QuadraticForm f = least_squares_form(columns, offset, target, nullptr);
  EXPECT_EQ(f.q_matrix, (std::vector<double>{1, 1, 1, 5}));
  EXPECT_EQ(f.q_vector, (std::vector<double>{3, 7}));
  EXPECT_DOUBLE_EQ(f.constant, 13);
  EXPECT_DOUBLE_EQ(f.at(std::vector<double>{1, 1}), 1);
}

TEST(GramGolden, MomentFormsByHand) {
  // One column (0, 2), offset (1, 1), flat. At x = 3 the picture is (1, 7): mean 4 = 3 * 1 + 1;
  // variance 9; Sobel / 8 at both pixels 4 * 6 / 8 = 3 (one side repeats): mean square 9.
  const core::Plane a = plane(2, 1, {0, 2}), offset = plane(2, 1, {1, 1});
  const core::Plane* columns[] = {&a};
  const MomentForms f = moment_forms(columns, offset, flat_pixel_map({2, 1}));
  ASSERT_EQ(f.mean.size(), 2u);
  EXPECT_DOUBLE_EQ(f.mean[0], 1);
  EXPECT_DOUBLE_EQ(f.mean[1], 1);
  EXPECT_NEAR(f.variance.at(std::vector<double>{3}), 9, 1e-9);
  EXPECT_NEAR(f.squared_gradient.at(std::vector<double>{3}), 9, 1e-9);
}

}  // namespace
}  // namespace chiaro::measure
