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

TEST(DecodePicture, AGifIsRefusedWithItsRemedy) {
  const std::string gif = "GIF89a____________________________";
  EXPECT_EQ(refusal({gif.begin(), gif.end()}),
            "a.png: GIF pictures are not read (save the frame you like as PNG or JPEG)");
}

TEST(DecodePicture, AnAnimatedWebpIsRefusedWithItsRemedy) {
  std::string webp = "RIFF____WEBPVP8X____";
  webp += '\x02';
  webp += "_____________________";
  EXPECT_EQ(refusal({webp.begin(), webp.end()}),
            "a.png: this WebP picture is animated (save the frame you like as PNG or JPEG)");
}

TEST(DecodePicture, AnAnimatedPngGivesItsFirstPicture) {
  // An acTL chunk (two frames, for ever) between IHDR and the picture; its CRC is right.
  std::vector<std::uint8_t> bytes = png(1, 1, PngColour::rgb, 8, {10, 20, 30});
  const std::vector<std::uint8_t> chunk{0, 0, 0, 8, 'a', 'c', 'T',  'L',  0,    0,
                                        0, 2, 0, 0, 0,   0,   0xf3, 0x8d, 0x93, 0x70};
  bytes.insert(bytes.begin() + 33, chunk.begin(), chunk.end());
  EXPECT_EQ(good(bytes).at(0, 0), (Pixel{10, 20, 30}));
}

TEST(DecodePicture, InksBecomeLight) {
  // 8 x 8 in CMYK as press and Photoshop write it (inverted): no cyan, much magenta and yellow.
  const std::vector<std::uint8_t> bytes{
      255, 216, 255, 238, 0,  14, 65, 100, 111, 98,  101, 0,  100, 0,   0,   0,   0,   0,  255, 219,
      0,   67,  0,   3,   2,  2,  3,  2,   2,   3,   3,   3,  3,   4,   3,   3,   4,   5,  8,   5,
      5,   4,   4,   5,   10, 7,  7,  6,   8,   12,  10,  12, 12,  11,  10,  11,  11,  13, 14,  18,
      16,  13,  14,  17,  14, 11, 11, 16,  22,  16,  17,  19, 20,  21,  21,  21,  12,  15, 23,  24,
      22,  20,  24,  18,  20, 21, 20, 255, 192, 0,   20,  8,  0,   8,   0,   8,   4,   67, 17,  0,
      77,  17,  0,   89,  17, 0,  75, 17,  0,   255, 196, 0,  21,  0,   1,   1,   0,   0,  0,   0,
      0,   0,   0,   0,   0,  0,  0,  0,   0,   0,   8,   9,  255, 196, 0,   20,  16,  1,  0,   0,
      0,   0,   0,   0,   0,  0,  0,  0,   0,   0,   0,   0,  0,   0,   255, 218, 0,   14, 4,   67,
      0,   77,  0,   89,  0,  75, 0,  0,   63,  0,   170, 97, 224, 120, 170, 111, 255, 217};
  const Pixel seen = good(bytes).at(4, 4);
  EXPECT_GT(seen[0], 240);
  EXPECT_NEAR(seen[1], 55, 12);
  EXPECT_NEAR(seen[2], 55, 12);
}

TEST(DecodePicture, ATiffOfSixteenBitsIsRead) {
  // Little-endian, one strip, RGB 16 bit, 2 x 1.
  std::vector<std::uint8_t> bytes{'I', 'I', 42, 0, 8, 0, 0, 0};
  const auto put = [&](std::uint32_t v, int n) {
    for (int i = 0; i < n; ++i) bytes.push_back(static_cast<std::uint8_t>(v >> (8 * i)));
  };
  const auto tag = [&](std::uint32_t id, std::uint32_t type, std::uint32_t n, std::uint32_t v) {
    put(id, 2), put(type, 2), put(n, 4), put(v, 4);
  };
  put(9, 2);
  tag(256, 3, 1, 2), tag(257, 3, 1, 1), tag(258, 3, 3, 122), tag(259, 3, 1, 1), tag(262, 3, 1, 2);
  tag(273, 4, 1, 128), tag(277, 3, 1, 3), tag(278, 3, 1, 1), tag(279, 4, 1, 12);
  put(0, 4);
  put(16, 2), put(16, 2), put(16, 2);
  for (const std::uint32_t v : {0u, 257u * 100, 65535u, 257u * 7, 257u * 8, 257u * 9}) put(v, 2);
  const auto picture = good(bytes);
  ASSERT_EQ(picture.size, (Size{2, 1}));
  EXPECT_EQ(picture.at(0, 0), (Pixel{0, 100, 255}));
  EXPECT_EQ(picture.at(1, 0), (Pixel{7, 8, 9}));
}

TEST(DecodePicture, FiftyMegapixelsAreReadAndShrunkToWhatLightNeeds) {
  constexpr Size kSize{8192, 6144};
  std::vector<std::uint8_t> file;
  {
    EncodedPicture large(kSize, {40, 80, 160});
    for (int y = 0; y < kSize.height; ++y)
      std::fill(large.row(y), large.row(y) + kSize.width / 2, std::array<std::uint8_t, 3>{});
    file = encode_jpeg(large, 60);
  }
  const EncodedPicture picture = good(file);
  ASSERT_EQ(picture.size, kSize);
  const Picture light = linear_at_most(picture);
  EXPECT_LE(light.size().pixels(), kPixelsOfExemplar);
  EXPECT_GE(light.size().pixels(), kPixelsOfExemplar / 2);
  EXPECT_NEAR(light.at(light.size().width - 5, 5).b, srgb_linear(160 / 255.0), 0.02);
  EXPECT_NEAR(light.at(5, 5).b, 0, 0.002);
}

TEST(LinearAtMost, AveragesLightAndLeavesSmallPicturesAlone) {
  EncodedPicture picture({4, 2}, {255, 255, 255});
  picture.at(0, 0) = picture.at(1, 0) = {0, 0, 0};
  const Picture small = linear_at_most(picture, 2);
  EXPECT_EQ(small.size(), (Size{2, 1}));
  EXPECT_NEAR(small.at(0, 0).r, 0.5, 1e-6);
  EXPECT_NEAR(small.at(1, 0).r, 1, 1e-6);
  EXPECT_EQ(linear_at_most(picture, 8).red, linear(picture).red);
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
