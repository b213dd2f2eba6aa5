// SPDX-License-Identifier: Apache-2.0
// Numbers that remember their unit. Used where values cross a stage's edge; inner loops work on
// plain floats whose unit is in the name.
#pragma once

#include <compare>
#include <numbers>

namespace chiaro::core {

template <class Tag>
struct Quantity {
  double value = 0;
  friend constexpr auto operator<=>(Quantity, Quantity) = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return {a.value + b.value}; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return {a.value - b.value}; }
  friend constexpr Quantity operator*(double k, Quantity q) { return {k * q.value}; }
  friend constexpr Quantity operator*(Quantity q, double k) { return {k * q.value}; }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

using Lux = Quantity<struct LuxTag>;
using Candela = Quantity<struct CandelaTag>;
using Kelvin = Quantity<struct KelvinTag>;
using Hertz = Quantity<struct HertzTag>;
using Stops = Quantity<struct StopsTag>;

inline constexpr double kPi = std::numbers::pi;
/// Angles are plain radians inside; these are the only two doors to degrees.
constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// Factor of light for a number of stops, and back. Precondition of the second: ratio > 0.
double from_stops(double stops);
double to_stops(double ratio);

struct Range {
  double least = 0, most = 0;
  constexpr bool contains(double x) const { return x >= least && x <= most; }
  constexpr double clamp(double x) const { return x < least ? least : x > most ? most : x; }
  constexpr double width() const { return most - least; }
  friend bool operator==(const Range&, const Range&) = default;
};

}  // namespace chiaro::core
