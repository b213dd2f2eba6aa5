// SPDX-License-Identifier: Apache-2.0
#include "controller/patch/curve.h"

#include <algorithm>
#include <cmath>

namespace chiaro::patch {

using Law = studio::DimmerCurve::Law;

namespace {

double light_in(const std::vector<double>& table, double drive) {
  if (table.size() < 2) return drive;
  const double place = drive * static_cast<double>(table.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), table.size() - 2);
  return std::lerp(table[i], table[i + 1], place - static_cast<double>(i));
}

double drive_in(const std::vector<double>& table, double light) {
  if (table.size() < 2) return light;
  if (light <= table.front()) return 0;
  const auto above = std::lower_bound(table.begin(), table.end(), light);
  if (above == table.end()) return 1;
  const double reach = *above - *(above - 1);  // > 0: *(above - 1) < light <= *above
  const double step = (light - *(above - 1)) / reach;
  return (static_cast<double>(above - table.begin() - 1) + step) /
         static_cast<double>(table.size() - 1);
}

}  // namespace

double light_of_drive(const studio::DimmerCurve& curve, double drive) {
  const double d = std::clamp(drive, 0.0, 1.0);
  switch (curve.law) {
    case Law::linear:
      return d;
    case Law::square:
      return d * d;
    case Law::gamma:
      return std::pow(d, curve.gamma);
    case Law::s_curve:
      return d * d * (3 - 2 * d);
    case Law::table:
      return light_in(curve.table, d);
  }
  return d;
}

double drive_of_light(const studio::DimmerCurve& curve, double light) {
  const double l = std::clamp(light, 0.0, 1.0);
  switch (curve.law) {
    case Law::linear:
      return l;
    case Law::square:
      return std::sqrt(l);
    case Law::gamma:
      return std::pow(l, 1 / curve.gamma);
    // The root of 3d^2 - 2d^3 = l in 0..1, by the trigonometric solution of the cubic.
    case Law::s_curve:
      return std::clamp(0.5 - std::sin(std::asin(1 - 2 * l) / 3), 0.0, 1.0);
    case Law::table:
      return std::clamp(drive_in(curve.table, l), 0.0, 1.0);
  }
  return l;
}

}  // namespace chiaro::patch
