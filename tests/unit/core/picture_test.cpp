// SPDX-License-Identifier: Apache-2.0
#include "controller/core/picture.h"

#include <gtest/gtest.h>

#include "controller/core/random.h"

namespace chiaro::core {
namespace {

Plane plane(Size size, std::vector<float> values) {
  Plane out(size);
  out.values = std::move(values);
  return out;
}

TEST(Resize, HalvingAveragesTheFourPixels) {
  const Plane small = resized(plane({4, 2}, {1, 2, 3, 4,  //
                                             5, 6, 7, 8}),
                              {2, 1});
  EXPECT_EQ(small.values, (std::vector<float>{3.5f, 5.5f}));
}

TEST(Resize, ThirdsShareThePixelBetweenThem) {
  // 3 to 2: each new pixel is one whole and one half old pixel, over 1.5.
  const Plane small = resized(plane({3, 1}, {3, 6, 9}), {2, 1});
  EXPECT_NEAR(small.values[0], (3 + 0.5 * 6) / 1.5, 1e-6);
  EXPECT_NEAR(small.values[1], (0.5 * 6 + 9) / 1.5, 1e-6);
}

TEST(Resize, EnlargingInterpolatesBetweenCentres) {
  // Centres of the four stand at 0.25, 0.75, 1.25, 1.75; the old ones at 0.5 and 1.5.
  const Plane large = resized(plane({2, 1}, {0, 4}), {4, 1});
  EXPECT_EQ(large.values, (std::vector<float>{0, 1, 3, 4}));
}

TEST(Resize, KeepsTheMeanWhenShrinking) {
  Random random(3);
  Plane big({97, 61});
  double mean = 0;
  for (float& v : big.values) mean += v = static_cast<float>(random.uniform());
  mean /= static_cast<double>(big.values.size());
  for (const Size size : {Size{13, 7}, Size{96, 60}, Size{1, 1}, Size{97, 10}}) {
    double small_mean = 0;
    for (const float v : resized(big, size).values) small_mean += v;
    EXPECT_NEAR(small_mean / static_cast<double>(size.pixels()), mean, 1e-5);
  }
}

TEST(Resize, AFlatPictureStaysFlatAtEverySize) {
  Picture flat({17, 9});
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 17; ++x) flat.set(x, y, {0.25, 0.5, 0.75});
  for (const Size size : {Size{5, 4}, Size{40, 30}, Size{17, 9}, Size{1, 50}}) {
    const Picture out = resized(flat, size);
    ASSERT_EQ(out.size(), size);
    for (std::size_t i = 0; i < size.pixels(); ++i) {
      EXPECT_NEAR(out.red.values[i], 0.25, 1e-6);
      EXPECT_NEAR(out.blue.values[i], 0.75, 1e-6);
    }
  }
}

TEST(Encoding, EveryByteSurvivesLinearLight) {
  EncodedPicture all({256, 1});
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    all.at(i, 0) = {byte, static_cast<std::uint8_t>(255 - i), byte};
  }
  EXPECT_EQ(encoded(linear(all)), all);
}

TEST(Encoding, ClipsWhatTheDisplayCannotShow) {
  Picture picture({2, 1});
  picture.set(0, 0, {7, -1, 0.21586});
  EXPECT_EQ(encoded(picture).at(0, 0), (std::array<std::uint8_t, 3>{255, 0, 128}));
}

TEST(Luminance, WeighsThePrimaries) {
  Picture picture({3, 1});
  picture.set(0, 0, {1, 0, 0});
  picture.set(1, 0, {0, 1, 0});
  picture.set(2, 0, {0, 0, 1});
  const Plane y = luminance(picture);
  EXPECT_FLOAT_EQ(y.at(0, 0), 0.2126f);
  EXPECT_FLOAT_EQ(y.at(1, 0), 0.7152f);
  EXPECT_FLOAT_EQ(y.at(2, 0), 0.0722f);
}

TEST(Grid, RowsRunFromTheTop) {
  Grid<int> grid({2, 2});
  grid.at(1, 0) = 7;
  EXPECT_EQ(grid.values, (std::vector<int>{0, 7, 0, 0}));
  EXPECT_EQ(grid.row(0)[1], 7);
}

}  // namespace
}  // namespace chiaro::core
