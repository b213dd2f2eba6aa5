// SPDX-License-Identifier: Apache-2.0
#include "simulator/bust/bust.h"

#include <cmath>

#include "simulator/bust/parts.h"
#include "simulator/bust/shapes.h"

namespace chiaro::simulator {
namespace {

constexpr double kCentimetre = 0.01;
/// Centimetres over which the two mirrored halves are rounded into each other.
constexpr double kSeam = 0.15;

double body(core::Vec3 p) {
  using namespace clay;
  double head = skull_and_flesh(p);
  head = with_eyes(head, p);
  head = with_nose(head, p);
  head = with_mouth(head, p);
  const double whole = joined(head, neck_and_shoulders(p), 2.0);
  return with_hair(with_ears(whole, p), p);
}

}  // namespace

double bust_distance(core::Vec3 p) {
  const double x = p.x / kCentimetre;
  const core::Vec3 local{std::sqrt(x * x + kSeam * kSeam) - kSeam, -p.y / kCentimetre,
                         (p.z - kEyeHeight) / kCentimetre};
  return std::max(kCentimetre * body(local), -p.z);
}

core::Vec3 bust_normal(core::Vec3 p) {
  constexpr double h = 2e-4;
  const auto slope = [&](core::Vec3 d) { return bust_distance(p + d) - bust_distance(p - d); };
  return core::unit({slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})});
}

}  // namespace chiaro::simulator
