// SPDX-License-Identifier: Apache-2.0
#include "tests/support/png.h"

#include <algorithm>
#include <string_view>

namespace chiaro::support {
namespace {

using Bytes = std::vector<std::uint8_t>;

void add(Bytes& to, std::uint32_t value, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    to.push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(shift)));
}

std::uint32_t crc32(const Bytes& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1u) ^ (crc & 1u ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::uint32_t adler32(const Bytes& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16u | a;
}

void add_chunk(Bytes& file, std::string_view type, const Bytes& data) {
  add(file, static_cast<std::uint32_t>(data.size()), 4);
  Bytes body(type.begin(), type.end());
  body.insert(body.end(), data.begin(), data.end());
  file.insert(file.end(), body.begin(), body.end());
  add(file, crc32(body), 4);
}

/// zlib with stored blocks of at most 65535 bytes.
Bytes stored(const Bytes& raw) {
  Bytes out{0x78, 0x01};
  for (std::size_t at = 0; at < raw.size() || at == 0;) {
    const std::size_t length = std::min<std::size_t>(65535, raw.size() - at);
    out.push_back(at + length >= raw.size());
    for (const auto n : {length, ~length}) {
      out.push_back(static_cast<std::uint8_t>(n & 0xffu));
      out.push_back(static_cast<std::uint8_t>((n >> 8u) & 0xffu));
    }
    out.insert(out.end(), raw.begin() + static_cast<std::ptrdiff_t>(at),
               raw.begin() + static_cast<std::ptrdiff_t>(at + length));
    at += std::max<std::size_t>(1, length);
  }
  add(out, adler32(raw), 4);
  return out;
}

}  // namespace

std::vector<std::uint8_t> png(std::uint32_t width, std::uint32_t height, PngColour colour, int bits,
                              const std::vector<std::uint16_t>& samples) {
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  add(header, width, 4);
  add(header, height, 4);
  for (const int byte : {bits, static_cast<int>(colour), 0, 0, 0})
    header.push_back(static_cast<std::uint8_t>(byte));
  add_chunk(file, "IHDR", header);
  const std::size_t channels = colour == PngColour::grey         ? 1
                               : colour == PngColour::grey_alpha ? 2
                               : colour == PngColour::rgb        ? 3
                                                                 : 4;
  Bytes rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % (width * channels) == 0) rows.push_back(0);  // filter: none
    add(rows, samples[i], bits / 8);
  }
  add_chunk(file, "IDAT", stored(rows));
  add_chunk(file, "IEND", {});
  return file;
}

}  // namespace chiaro::support
