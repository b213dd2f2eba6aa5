// SPDX-License-Identifier: Apache-2.0
// Colour as cameras and lamps need it: linear sRGB (IEC 61966-2-1, D65), its encoding, luminance
// and L*, and the colour of a lamp of a given CCT and tint as a white-balanced camera sees it.
#pragma once

#include <array>

#include "controller/core/units.h"

namespace chiaro::core {

/// Linear light, sRGB primaries. 1 = the display's white.
struct Rgb {
  double r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb, Rgb) = default;
  friend constexpr Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
  friend constexpr Rgb operator*(double k, Rgb c) { return {k * c.r, k * c.g, k * c.b}; }
  friend constexpr Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
};

/// Relative luminance Y of linear sRGB; [I-21] in its right form.
inline constexpr std::array<float, 3> kLuminance{0.2126f, 0.7152f, 0.0722f};
constexpr double luminance(Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// The sRGB transfer curve, 0..1 to 0..1; values outside are clipped.
double srgb_encoded(double linear);
double srgb_linear(double encoded);

/// CIE lightness 0..100 of a relative luminance (white = 1), with its linear part near black
/// [I-22]; negative input counts as 0. And its inverse.
double lightness(double relative_luminance);
double luminance_of_lightness(double lightness);

struct Xyz {
  double x = 0, y = 0, z = 0;
};
struct Lab {
  double l = 0, a = 0, b = 0;
};
struct Chromaticity {
  double x = 0, y = 0;
};
Xyz xyz_of(Rgb linear);
Rgb rgb_of(Xyz xyz);
Lab lab_of(Rgb linear);

/// Chromaticity of a white light: Planckian below 4000 K, CIE daylight above 5000 K, a linear
/// blend between (lamps sold as "3200 K" and "5600 K" follow these two). `tint` is Duv in
/// thousandths: positive is greener, negative more magenta (gaffers' plus/minus green).
/// Precondition: 1000 K <= cct <= 25000 K.
Chromaticity white_chromaticity(Kelvin cct, double tint = 0);

/// Linear sRGB with luminance 1 of a light with that CCT and tint, seen by a camera balanced to
/// `balance` (Bradford adaptation). Equal CCTs give exactly (1, 1, 1). A component may be slightly
/// negative for very warm lamps; it is clipped to 0 and luminance is restored.
Rgb white_light(Kelvin cct, double tint, Kelvin balance);
/// The same for any chromaticity (saturated LEDs).
Rgb coloured_light(Chromaticity chromaticity, Kelvin balance);

}  // namespace chiaro::core
