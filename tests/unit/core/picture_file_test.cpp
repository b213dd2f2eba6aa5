// SPDX-License-Identifier: Apache-2.0
#include "controller/core/picture_file.h"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/fake_world.h"
#include "tests/support/png.h"

namespace chiaro::core {
namespace {

using support::png;
using support::PngColour;
using Pixel = std::array<std::uint8_t, 3>;

EncodedPicture good(const std::vector<std::uint8_t>& bytes) {
  const auto picture = decode_picture(bytes, "a.png");
  EXPECT_TRUE(picture.ok()) << to_string(picture.problems());
  return picture.ok() ? *picture : EncodedPicture({1, 1});
}
std::string refusal(const std::vector<std::uint8_t>& bytes) {
  const auto picture = decode_picture(bytes, "a.png");
  return picture.ok() ? "" : to_string(picture.problems().front());
}

TEST(DecodePicture, ColourInItsOrder) {
  const auto picture = good(png(2, 1, PngColour::rgb, 8, {10, 20, 30, 250, 128, 0}));
  EXPECT_EQ(picture.size, (Size{2, 1}));
  EXPECT_EQ(picture.at(0, 0), (Pixel{10, 20, 30}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{250, 128, 0}));
}

TEST(DecodePicture, GreyBecomesThreeEqualChannels) {
  EXPECT_EQ(good(png(1, 1, PngColour::grey, 8, {77})).at(0, 0), (Pixel{77, 77, 77}));
}

TEST(DecodePicture, SixteenBitsAreRoundedToEight) {
  const auto picture = good(png(2, 1, PngColour::rgb, 16, {0, 257, 65535, 25700, 25828, 25829}));
  EXPECT_EQ(picture.at(0, 0), (Pixel{0, 1, 255}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{100, 100, 101}));
  EXPECT_EQ(good(png(1, 1, PngColour::grey, 16, {257 * 9})).at(0, 0), (Pixel{9, 9, 9}));
}

TEST(DecodePicture, TransparencyShowsMidGrey) {
  const auto picture =
      good(png(3, 1, PngColour::rgba, 8, {200, 100, 0, 255, 200, 100, 0, 0, 255, 255, 255, 128}));
  EXPECT_EQ(picture.at(0, 0), (Pixel{200, 100, 0}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{119, 119, 119}));
  EXPECT_EQ(picture.at(2, 0), (Pixel{187, 187, 187}));  // (255 * 128 + 119 * 127) / 255
}

TEST(DecodePicture, GreyWithTransparencyToo) {
  const auto picture = good(png(2, 1, PngColour::grey_alpha, 8, {200, 255, 200, 0}));
  EXPECT_EQ(picture.at(0, 0), (Pixel{200, 200, 200}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{119, 119, 119}));
}

TEST(DecodePicture, EmptyIsSaid) {
  EXPECT_EQ(refusal({}), "a.png: the picture is empty (0 bytes) (export it again as PNG or JPEG)");
}

TEST(DecodePicture, NoPixelsAreSaid) {
  EXPECT_EQ(refusal(png(0, 0, PngColour::rgb, 8, {})),
            "a.png: the picture has no pixels (0 x 0) (export it again)");
  EXPECT_NE(refusal(png(5, 0, PngColour::rgb, 8, {})), "");
}

TEST(DecodePicture, AHundredMegapixelsAreRefusedByTheirHeader) {
  EXPECT_EQ(refusal(png(10000, 10000, PngColour::rgb, 8, {1, 2, 3})),
            "a.png: the picture has 100 megapixels, at most 67 are read (make it smaller: 2 "
            "megapixels are plenty)");
  EXPECT_NE(refusal(png(0xffffffffu, 0xffffffffu, PngColour::grey, 8, {1})), "");
}

TEST(DecodePicture, CutShortIsRefusedOrGivesItsWholeSize) {
  EncodedPicture picture({40, 30}, {90, 120, 200});
  const auto whole = encode_png(picture);
  for (std::size_t length = 1; length + 30 < whole.size(); length += 7) {
    const std::vector<std::uint8_t> part(whole.begin(),
                                         whole.begin() + static_cast<std::ptrdiff_t>(length));
    const auto decoded = decode_picture(part, "a.png");
    if (decoded.ok()) {
      EXPECT_EQ(decoded->size, picture.size);
    }
  }
  EXPECT_NE(refusal({whole.begin(), whole.begin() + 20}), "");
}

TEST(DecodePicture, WhatIsNoPictureIsSaid) {
  const std::string text = "studio: not a picture\n";
  EXPECT_EQ(refusal({text.begin(), text.end()}),
            "a.png: this is not a picture that can be read (damaged, cut short, or another format) "
            "(export it as PNG or JPEG)");
  EXPECT_NE(refusal(std::vector<std::uint8_t>(1000, 0)), "");
}

TEST(DecodePicture, HeicIsNamed) {
  const std::string heic = std::string("\0\0\0\x18", 4) + "ftypheic" + std::string(12, '\0');
  EXPECT_EQ(refusal({heic.begin(), heic.end()}),
            "a.png: HEIC and AVIF pictures are not read (export it as PNG or JPEG)");
}

/// The JPEG with an EXIF block that says how it is to be turned.
std::vector<std::uint8_t> with_orientation(std::vector<std::uint8_t> jpeg, std::uint8_t turn) {
  const std::uint8_t exif[] = {0xff, 0xe1, 0, 34, 'E', 'x',  'i', 'f', 0, 0,    'M', 'M',
                               0,    42,   0, 0,  0,   8,    0,   1,   1, 0x12, 0,   3,
                               0,    0,    0, 1,  0,   turn, 0,   0,   0, 0,    0,   0};
  jpeg.insert(jpeg.begin() + 2, std::begin(exif), std::end(exif));
  return jpeg;
}

TEST(DecodePicture, ExifTurnsAJpegUpright) {
  EncodedPicture picture({32, 16}, {255, 255, 255});  // left half white, right half black
  for (int y = 0; y < 16; ++y)
    for (int x = 16; x < 32; ++x) picture.at(x, y) = {0, 0, 0};
  const auto jpeg = encode_jpeg(picture, 95);
  EXPECT_EQ(good(with_orientation(jpeg, 1)).size, (Size{32, 16}));
  // 6: the camera was turned; the left of the file is the top of the picture.
  const auto turned = good(with_orientation(jpeg, 6));
  ASSERT_EQ(turned.size, (Size{16, 32}));
  EXPECT_GT(turned.at(8, 3)[0], 240);
  EXPECT_LT(turned.at(8, 28)[0], 15);
  // 3: upside down.
  const auto over = good(with_orientation(jpeg, 3));
  EXPECT_LT(over.at(3, 8)[0], 15);
  EXPECT_GT(over.at(28, 8)[0], 240);
}

TEST(PictureFile, PngsComeBackAsTheyWere) {
  support::TemporaryFolder folder;
  EncodedPicture picture({5, 3});
  for (std::size_t i = 0; i < picture.values.size(); ++i)
    picture.values[i] = {static_cast<std::uint8_t>(i * 17), static_cast<std::uint8_t>(255 - i * 13),
                         static_cast<std::uint8_t>(i * i)};
  const auto file = folder.path() / "a.png";
  ASSERT_TRUE(write_png(file, picture).ok());
  const auto back = read_picture(file);
  ASSERT_TRUE(back.ok()) << to_string(back.problems());
  EXPECT_EQ(*back, picture);
}

TEST(PictureFile, ExrKeepsLightBeyondWhiteAndBelowBlack) {
  support::TemporaryFolder folder;
  Picture picture({3, 2});
  picture.set(0, 0, {0.25, 12.5, -0.125});
  picture.set(2, 1, {1e-6, 3, 100});
  const auto file = folder.path() / "a.exr";
  ASSERT_TRUE(write_exr(file, picture).ok());
  const auto back = read_exr(file);
  ASSERT_TRUE(back.ok()) << to_string(back.problems());
  EXPECT_EQ(back->red, picture.red);
  EXPECT_EQ(back->green, picture.green);
  EXPECT_EQ(back->blue, picture.blue);
}

TEST(PictureFile, WhatIsMissingOrUnreadableIsSaid) {
  support::TemporaryFolder folder;
  const auto nowhere = folder.path() / "nowhere.png";
  const auto missing = read_picture(nowhere);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(to_string(missing.problems().front()),
            nowhere.string() + ": there is no such picture (check the path)");
  EXPECT_FALSE(read_picture(folder.path()).ok());
  EXPECT_FALSE(read_exr(nowhere).ok());
  std::ofstream(folder.path() / "text.exr") << "not an exr";
  EXPECT_FALSE(read_exr(folder.path() / "text.exr").ok());
  EXPECT_FALSE(write_png(folder.path() / "no/such/folder.png", EncodedPicture({1, 1})).ok());
  EXPECT_FALSE(write_exr(folder.path() / "no/such/folder.exr", Picture({1, 1})).ok());
}

}  // namespace
}  // namespace chiaro::core
