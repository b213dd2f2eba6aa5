// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/one_look.h"

#include <gtest/gtest.h>

namespace chiaro::daemon {
namespace {

core::EncodedPicture plain(core::Size size, std::uint8_t grey) {
  return core::EncodedPicture(size, {grey, grey, grey});
}

TEST(DemoPicture, IsCutToItsMiddle) {
  auto wide = plain({8, 4}, 10);
  wide.at(2, 0)[0] = 99;
  const auto square = cropped(wide, 1);
  EXPECT_EQ(square.size, (core::Size{4, 4}));
  EXPECT_EQ(square.at(0, 0)[0], 99);
  EXPECT_EQ(cropped(plain({4, 8}, 0), 2).size, (core::Size{4, 2}));
}

TEST(DemoPicture, DifferenceIsInLightnessOfWhatBothShow) {
  EXPECT_NEAR(lightness_difference(plain({64, 48}, 119), plain({32, 32}, 119)), 0, 1e-4);
  EXPECT_NEAR(lightness_difference(plain({64, 48}, 0), plain({32, 32}, 255)), 100, 0.01);
  // sRGB 119 is L* 50.03 (CIE 1976 of its luminance 0.1845).
  EXPECT_NEAR(lightness_difference(plain({8, 8}, 0), plain({8, 8}, 119)), 50.03, 0.05);
}

TEST(DemoPicture, ShowsAllThreeInOneShape) {
  MadeLook look;
  look.reference = plain({64, 48}, 1);
  look.preview = plain({32, 32}, 2);
  look.camera = plain({80, 60}, 3);
  const auto picture = side_by_side(look);
  EXPECT_EQ(picture.size, (core::Size{3 * 60 + 16, 60}));
  EXPECT_EQ(picture.at(0, 30)[0], 1);
  EXPECT_EQ(picture.at(64, 30)[0], 255);
  EXPECT_EQ(picture.at(70, 30)[0], 2);
  EXPECT_EQ(picture.at(195, 59)[0], 3);
}

}  // namespace
}  // namespace chiaro::daemon
