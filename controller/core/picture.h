// SPDX-License-Identifier: Apache-2.0
// Pictures as values. Rows run from the top, pixel (x, y) has its centre at (x + 0.5, y + 0.5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "controller/core/colour.h"

namespace chiaro::core {

struct Size {
  int width = 0, height = 0;
  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  friend bool operator==(const Size&, const Size&) = default;
};

/// A row-major grid of values.
template <class T>
struct Grid {
  Size size;
  std::vector<T> values;

  Grid() = default;
  explicit Grid(Size s, T fill = {}) : size(s), values(s.pixels(), fill) {}
  T& at(int x, int y) { return values[index(x, y)]; }
  const T& at(int x, int y) const { return values[index(x, y)]; }
  T* row(int y) { return values.data() + index(0, y); }
  const T* row(int y) const { return values.data() + index(0, y); }
  bool empty() const { return values.empty(); }
  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }
};
using Plane = Grid<float>;

/// Linear light, display-referred sRGB primaries: 0 = black, 1 = the value at which the camera
/// clips. Values may exceed 1 until they are encoded. The three planes have one size.
struct Picture {
  Plane red, green, blue;
  Picture() = default;
  explicit Picture(Size size) : red(size), green(size), blue(size) {}
  Size size() const { return red.size; }
  Rgb at(int x, int y) const { return {red.at(x, y), green.at(x, y), blue.at(x, y)}; }
  void set(int x, int y, Rgb c) {
    red.at(x, y) = static_cast<float>(c.r);
    green.at(x, y) = static_cast<float>(c.g);
    blue.at(x, y) = static_cast<float>(c.b);
  }
};

/// 8-bit sRGB, what a camera delivers and a file holds.
using EncodedPicture = Grid<std::array<std::uint8_t, 3>>;

EncodedPicture encoded(const Picture& linear);
Picture linear(const EncodedPicture& picture);
/// Relative luminance Y per pixel.
Plane luminance(const Picture& picture);
/// Area-averaging resize in linear light (bilinear when enlarging). Precondition: size not empty.
Picture resized(const Picture& picture, Size size);
Plane resized(const Plane& plane, Size size);

}  // namespace chiaro::core
