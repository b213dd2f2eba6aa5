// SPDX-License-Identifier: Apache-2.0
#include "controller/twin/aim.h"

#include <algorithm>
#include <cmath>

namespace chiaro::twin {
namespace {

constexpr double kTurn = 2 * core::kPi;
constexpr double kSlack = 1e-9;  // a range read from degrees

struct Direction {
  double azimuth, elevation;
  bool along_axis;
};
std::optional<Direction> direction(core::Vec3 v) {
  const double flat = std::hypot(v.x, v.y);
  if (std::hypot(flat, v.z) < 1e-6) return std::nullopt;
  return Direction{std::atan2(v.y, v.x), std::atan2(v.z, flat), flat < 1e-9};
}

/// The value congruent to `angle` within `range` that is nearest to `from`.
std::optional<double> turned(double angle, core::Range range, double from) {
  const double nearest = angle + kTurn * std::round((from - angle) / kTurn);
  std::optional<double> best;
  for (int k = -4; k <= 4; ++k) {
    const double each = nearest + k * kTurn;
    if (each < range.least - kSlack || each > range.most + kSlack) continue;
    if (!best || std::abs(each - from) < std::abs(*best - from)) best = range.clamp(each);
  }
  return best;
}

}  // namespace

std::optional<PanTilt> aimed_at(const studio::PanTiltMount& mount, core::Range pan,
                                core::Range tilt, core::Vec3 target, PanTilt from) {
  const auto neutral = direction(mount.aim_at - mount.at), wanted = direction(target - mount.at);
  if (!neutral || !wanted) return std::nullopt;
  const double turn = wanted->azimuth - neutral->azimuth;
  const double lift = wanted->elevation - neutral->elevation;
  // Over the top: half a turn further, and tilted back by what is left to the other side.
  const double over = core::kPi - wanted->elevation - neutral->elevation;
  std::optional<PanTilt> best;
  double least = 0;
  const auto consider = [&](double p, double t) {
    const auto panned =
        wanted->along_axis ? std::optional(pan.clamp(from.pan)) : turned(p, pan, from.pan);
    const auto tilted = turned(t, tilt, from.tilt);
    if (!panned || !tilted) return;
    const double way = std::max(std::abs(*panned - from.pan), std::abs(*tilted - from.tilt));
    if (best && way >= least) return;
    best = PanTilt{*panned, *tilted};
    least = way;
  };
  consider(turn, lift);
  consider(turn + core::kPi, over);
  return best;
}

}  // namespace chiaro::twin
