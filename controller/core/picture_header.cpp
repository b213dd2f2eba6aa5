// SPDX-License-Identifier: Apache-2.0
#include "controller/core/picture_header.h"

#include <algorithm>
#include <string_view>

#include "controller/core/picture_file.h"

namespace chiaro::core {
namespace {

Problem refusal(const std::string& name, const std::string& what, const std::string& remedy) {
  return {{name, 0, 0}, what, remedy};
}

std::uint32_t big_endian(std::span<const std::uint8_t> b, std::size_t at, std::size_t bytes) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < bytes; ++i) v = v << 8u | b[at + i];
  return v;
}

/// The size a PNG or JPEG header claims, read before anything is allocated. Other formats: nothing.
std::optional<Size> claimed_size(std::span<const std::uint8_t> b) {
  if (b.size() > 24 && b[0] == 0x89 && b[1] == 'P')
    return Size{static_cast<int>(std::min(big_endian(b, 16, 4), 0x7fffffffu)),
                static_cast<int>(std::min(big_endian(b, 20, 4), 0x7fffffffu))};
  if (b.size() > 4 && b[0] == 0xff && b[1] == 0xd8) {
    for (std::size_t i = 2; i + 9 < b.size() && b[i] == 0xff;) {
      const std::uint8_t marker = b[i + 1];
      const bool frame =
          marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
      if (frame)
        return Size{static_cast<int>(big_endian(b, i + 7, 2)),
                    static_cast<int>(big_endian(b, i + 5, 2))};
      i += marker == 0xff ? 1 : 2 + big_endian(b, i + 2, 2);
    }
  }
  return std::nullopt;
}

bool is_heif(std::span<const std::uint8_t> b) {
  return b.size() > 12 && b[4] == 'f' && b[5] == 't' && b[6] == 'y' && b[7] == 'p';
}

bool starts_with(std::span<const std::uint8_t> b, std::size_t at, std::string_view text) {
  if (b.size() < at + text.size()) return false;
  return std::equal(text.begin(), text.end(), b.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c, std::uint8_t v) { return static_cast<std::uint8_t>(c) == v; });
}

/// What moves has no one light to follow. An animated PNG is also a picture: its first one is read.
std::optional<Problem> moving(std::span<const std::uint8_t> b, const std::string& name) {
  if (starts_with(b, 0, "GIF8"))
    return refusal(name, "GIF pictures are not read", "save the frame you like as PNG or JPEG");
  constexpr std::uint8_t kAnimated = 2;  // of the flags of a VP8X chunk
  if (starts_with(b, 0, "RIFF") && starts_with(b, 8, "WEBPVP8X") && b.size() > 20 &&
      (b[20] & kAnimated) != 0)
    return refusal(name, "this WebP picture is animated", "save the frame you like as PNG or JPEG");
  return std::nullopt;
}

}  // namespace

std::optional<Problem> header_problem(std::span<const std::uint8_t> bytes,
                                      const std::string& name) {
  if (bytes.empty())
    return refusal(name, "the picture is empty (0 bytes)", "export it again as PNG or JPEG");
  if (is_heif(bytes))
    return refusal(name, "HEIC and AVIF pictures are not read", "export it as PNG or JPEG");
  if (auto problem = moving(bytes, name)) return problem;
  const auto size = claimed_size(bytes);
  if (!size) return std::nullopt;
  if (size->width <= 0 || size->height <= 0)
    return refusal(name,
                   "the picture has no pixels (" + std::to_string(size->width) + " x " +
                       std::to_string(size->height) + ")",
                   "export it again");
  if (size->pixels() > kMostPixels)
    return refusal(name,
                   "the picture has " + std::to_string(size->pixels() / 1000000) +
                       " megapixels, at most " + std::to_string(kMostPixels / 1000000) +
                       " are read",
                   "make it smaller: 2 megapixels are plenty");
  return std::nullopt;
}

std::optional<Problem> unlike_a_picture(std::span<const std::uint8_t> bytes,
                                        const std::string& name) {
  if (auto problem = header_problem(bytes, name)) return problem;
  using namespace std::string_view_literals;
  static constexpr std::string_view kBeginnings[] = {"\x89PNG"sv, "\xff\xd8\xff"sv, "II*\0"sv,
                                                     "MM\0*"sv, "BM"sv};
  const bool known =
      std::any_of(std::begin(kBeginnings), std::end(kBeginnings),
                  [&](std::string_view beginning) { return starts_with(bytes, 0, beginning); }) ||
      (starts_with(bytes, 0, "RIFF") && starts_with(bytes, 8, "WEBP"));
  if (known) return std::nullopt;
  return refusal(name,
                 "this is not a picture that can be read (damaged, cut short, or another format)",
                 "export it as PNG or JPEG");
}

}  // namespace chiaro::core
