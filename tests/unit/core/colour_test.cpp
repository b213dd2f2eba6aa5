// SPDX-License-Identifier: Apache-2.0
// Values by hand or from CIE and IEC tables, not from the code.
#include "controller/core/colour.h"

#include <cmath>
#include <gtest/gtest.h>

namespace chiaro::core {
namespace {

TEST(Srgb, ValuesOfTheStandard) {
  EXPECT_DOUBLE_EQ(srgb_encoded(0), 0);
  EXPECT_NEAR(srgb_encoded(1), 1, 1e-12);
  // 1.055 * 0.18^(1/2.4) - 0.055
  EXPECT_NEAR(srgb_encoded(0.18), 0.461356, 1e-6);
  EXPECT_NEAR(srgb_linear(0.5), 0.214041, 1e-6);
  // The straight part near black: 12.92 * 0.002
  EXPECT_NEAR(srgb_encoded(0.002), 0.02584, 1e-12);
  EXPECT_NEAR(srgb_linear(0.02584), 0.002, 1e-12);
}

TEST(Srgb, ClipsOutsideAndInvertsInside) {
  EXPECT_DOUBLE_EQ(srgb_encoded(-0.5), 0);
  EXPECT_NEAR(srgb_encoded(7), 1, 1e-12);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_NEAR(srgb_encoded(srgb_linear(i / 1000.0)), i / 1000.0, 1e-4) << i;
}

// [I-22]
TEST(Lightness, ValuesOfCie1976) {
  EXPECT_NEAR(lightness(1), 100, 1e-9);
  EXPECT_NEAR(lightness(0.18), 49.4961, 1e-4);
  EXPECT_NEAR(lightness(0.1841865), 50, 1e-4);
  // The straight part: 24389/27 * 0.001
  EXPECT_NEAR(lightness(0.001), 0.903296, 1e-6);
  EXPECT_DOUBLE_EQ(lightness(-1), 0);
}

TEST(Lightness, InvertsAndHasNoStepWhereItsPartsMeet) {
  for (int l = 0; l <= 100; ++l) EXPECT_NEAR(lightness(luminance_of_lightness(l)), l, 1e-9);
  EXPECT_NEAR(lightness(216.0 / 24389 - 1e-9), lightness(216.0 / 24389 + 1e-9), 1e-5);
  EXPECT_DOUBLE_EQ(luminance_of_lightness(-3), 0);
}

TEST(Lab, OfThePrimariesAndGreys) {
  const Lab red = lab_of({1, 0, 0}), green = lab_of({0, 1, 0}), blue = lab_of({0, 0, 1});
  EXPECT_NEAR(red.l, 53.24, 0.02);
  EXPECT_NEAR(red.a, 80.09, 0.05);
  EXPECT_NEAR(red.b, 67.20, 0.05);
  EXPECT_NEAR(green.l, 87.74, 0.02);
  EXPECT_NEAR(green.a, -86.18, 0.05);
  EXPECT_NEAR(green.b, 83.18, 0.05);
  EXPECT_NEAR(blue.l, 32.30, 0.02);
  EXPECT_NEAR(blue.a, 79.19, 0.05);
  EXPECT_NEAR(blue.b, -107.86, 0.05);
  for (const double grey : {0.01, 0.18, 0.7, 1.0}) {
    EXPECT_NEAR(lab_of({grey, grey, grey}).a, 0, 0.02);
    EXPECT_NEAR(lab_of({grey, grey, grey}).b, 0, 0.02);
  }
}

// [I-21]
TEST(Xyz, InvertsToRgb) {
  const Rgb there{0.2, 0.5, 0.8};
  const Rgb back = rgb_of(xyz_of(there));
  EXPECT_NEAR(back.r, there.r, 1e-8);
  EXPECT_NEAR(back.g, there.g, 1e-8);
  EXPECT_NEAR(back.b, there.b, 1e-8);
  // White is D65.
  EXPECT_NEAR(xyz_of({1, 1, 1}).x, 0.95046, 1e-4);
  EXPECT_NEAR(xyz_of({1, 1, 1}).z, 1.08906, 1e-4);
}

TEST(WhiteChromaticity, OfTheStandardIlluminants) {
  const auto expect = [](double cct, double x, double y, double tolerance) {
    const Chromaticity c = white_chromaticity({cct});
    EXPECT_NEAR(c.x, x, tolerance) << cct;
    EXPECT_NEAR(c.y, y, tolerance) << cct;
  };
  // CIE 15: A, and daylight D50, D55, D65, D75 (whose nominal CCTs are 5003, 5503, 6504, 7504 K).
  expect(2856, 0.44757, 0.40745, 0.0006);
  expect(5003, 0.34567, 0.35850, 0.0002);
  expect(5503, 0.33242, 0.34743, 0.0002);
  expect(6504, 0.31271, 0.32902, 0.0002);
  expect(7504, 0.29902, 0.31485, 0.0002);
  // Planck's locus at 2000 and 3200 K (Wyszecki and Stiles).
  expect(2000, 0.5267, 0.4133, 0.0006);
  expect(3200, 0.4234, 0.3990, 0.0006);
}

TEST(WhiteChromaticity, RunsWithoutStepsFromLampToSky) {
  Chromaticity before = white_chromaticity({1500});
  for (double cct = 1510; cct < 20000; cct += 10) {
    const Chromaticity c = white_chromaticity({cct});
    EXPECT_LT(std::hypot(c.x - before.x, c.y - before.y), 0.002) << cct;
    EXPECT_LT(c.x, before.x + 1e-4) << cct;
    before = c;
  }
}

TEST(WhiteChromaticity, TintIsDuvInThousandthsAndPositiveIsGreener) {
  const auto uv = [](Chromaticity c) {
    const double d = -2 * c.x + 12 * c.y + 3;
    return std::pair(4 * c.x / d, 6 * c.y / d);
  };
  for (const double cct : {3200.0, 4500.0, 5600.0}) {
    const auto neutral = uv(white_chromaticity({cct})), green = uv(white_chromaticity({cct}, 10)),
               magenta = uv(white_chromaticity({cct}, -10));
    EXPECT_NEAR(std::hypot(green.first - neutral.first, green.second - neutral.second), 0.010,
                1e-6);
    EXPECT_GT(green.second, neutral.second);
    EXPECT_LT(magenta.second, neutral.second);
  }
}

TEST(WhiteLight, EqualTemperaturesAreExactlyWhite) {
  for (const double cct : {2700.0, 3200.0, 5600.0, 6500.0}) {
    const Rgb light = white_light({cct}, 0, {cct});
    EXPECT_EQ(light, (Rgb{1, 1, 1}));
  }
}

TEST(WhiteLight, IsContinuousAtTheBalance) {
  const Rgb near = white_light({5600.001}, 0, {5600});
  EXPECT_NEAR(near.r, 1, 1e-4);
  EXPECT_NEAR(near.g, 1, 1e-4);
  EXPECT_NEAR(near.b, 1, 1e-4);
}

TEST(WhiteLight, AlwaysHasLuminanceOneAndNoNegativeLight) {
  for (double cct = 1500; cct <= 12000; cct += 250)
    for (const double balance : {2700.0, 5600.0, 9000.0}) {
      const Rgb light = white_light({cct}, 0, {balance});
      EXPECT_NEAR(luminance(light), 1, 1e-12) << cct << " " << balance;
      EXPECT_GE(std::min({light.r, light.g, light.b}), 0) << cct;
    }
}

TEST(WhiteLight, WarmIsRedAndCoolIsBlue) {
  const Rgb warm = white_light({3200}, 0, {5600}), cool = white_light({5600}, 0, {3200});
  EXPECT_GT(warm.r, 1.3);
  EXPECT_LT(warm.b, 0.5);
  EXPECT_GT(cool.b, 1.5);
  EXPECT_LT(cool.r, 0.9);
}

TEST(ColouredLight, ASaturatedRedHasNoBlueAndItsLuminance) {
  const Rgb red = coloured_light({0.690, 0.308}, {5600});
  EXPECT_NEAR(luminance(red), 1, 1e-12);
  EXPECT_GT(red.r, 4);
  EXPECT_LT(red.b, 0.05);
}

}  // namespace
}  // namespace chiaro::core
