// SPDX-License-Identifier: Apache-2.0
#include "controller/core/picture.h"

#include <algorithm>
#include <cmath>

namespace chiaro::core {
namespace {

std::uint8_t encoded_byte(float linear) {
  // 4096 steps of the linear value are not enough near black; encode exactly.
  return static_cast<std::uint8_t>(std::lround(255.0 * srgb_encoded(static_cast<double>(linear))));
}

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<float>(srgb_linear(static_cast<double>(i) / 255.0));
    return t;
  }();
  return table;
}

struct Tap {
  int first = 0;
  std::vector<float> weights;
};

/// How much each source cell contributes to each target cell along one axis: box overlap when
/// shrinking, linear interpolation when enlarging.
std::vector<Tap> taps(int from, int to) {
  std::vector<Tap> all(static_cast<std::size_t>(to));
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Tap& tap = all[static_cast<std::size_t>(i)];
    if (scale >= 1) {
      const double begin = i * scale, end = begin + scale;
      tap.first = static_cast<int>(begin);
      const int last = std::min(from, static_cast<int>(std::ceil(end - 1e-9)));
      for (int s = tap.first; s < last; ++s)
        tap.weights.push_back(static_cast<float>(
            (std::min<double>(end, s + 1) - std::max<double>(begin, s)) / scale));
    } else {
      const double centre = std::clamp((i + 0.5) * scale - 0.5, 0.0, from - 1.0);
      tap.first = static_cast<int>(centre);
      const auto w = static_cast<float>(centre - tap.first);
      tap.weights.push_back(1 - w);
      if (w > 0) tap.weights.push_back(w);
    }
  }
  return all;
}

}  // namespace

EncodedPicture encoded(const Picture& linear) {
  EncodedPicture out(linear.size());
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = {encoded_byte(linear.red.values[i]), encoded_byte(linear.green.values[i]),
                     encoded_byte(linear.blue.values[i])};
  return out;
}

Picture linear(const EncodedPicture& picture) {
  Picture out(picture.size);
  const auto& table = linear_of_byte();
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    out.red.values[i] = table[picture.values[i][0]];
    out.green.values[i] = table[picture.values[i][1]];
    out.blue.values[i] = table[picture.values[i][2]];
  }
  return out;
}

Plane luminance(const Picture& picture) {
  Plane out(picture.size());
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = kLuminance[0] * picture.red.values[i] +
                    kLuminance[1] * picture.green.values[i] +
                    kLuminance[2] * picture.blue.values[i];
  return out;
}

Plane resized(const Plane& plane, Size size) {
  if (plane.size == size) return plane;
  const auto columns = taps(plane.size.width, size.width),
             rows = taps(plane.size.height, size.height);
  Plane narrow({size.width, plane.size.height});
  for (int y = 0; y < plane.size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Tap& tap = columns[static_cast<std::size_t>(x)];
      float sum = 0;
      for (std::size_t k = 0; k < tap.weights.size(); ++k)
        sum += tap.weights[k] * plane.at(tap.first + static_cast<int>(k), y);
      narrow.at(x, y) = sum;
    }
  Plane out(size);
  for (int y = 0; y < size.height; ++y) {
    const Tap& tap = rows[static_cast<std::size_t>(y)];
    for (std::size_t k = 0; k < tap.weights.size(); ++k) {
      const float* from = narrow.row(tap.first + static_cast<int>(k));
      float* to = out.row(y);
      for (int x = 0; x < size.width; ++x) to[x] += tap.weights[k] * from[x];
    }
  }
  return out;
}

Picture resized(const Picture& picture, Size size) {
  Picture out;
  out.red = resized(picture.red, size);
  out.green = resized(picture.green, size);
  out.blue = resized(picture.blue, size);
  return out;
}

}  // namespace chiaro::core
