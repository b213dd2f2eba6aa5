// SPDX-License-Identifier: Apache-2.0
// The piecewise law of a channel, there and back.
#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/studio/profile.h"

namespace chiaro::studio {

double fraction_of(const std::vector<Segment>& segments, double value) {
  if (segments.empty()) return value;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const Segment& s : segments) {
    if (s.law == Segment::Law::no_effect) continue;
    if (s.law == Segment::Law::neutral) {
      // The middle of a dead band, far from the meanings on either side.
      if (const double gap = std::abs(value - s.physical_from); gap < least)
        least = gap, best = 0.5 * (s.dmx_from + s.dmx_to);
      continue;
    }
    const auto [low, high] = std::minmax(s.physical_from, s.physical_to);
    const double near = std::clamp(value, low, high);
    if (const double gap = std::abs(value - near); gap < least) {
      const double width = s.physical_to - s.physical_from;
      const double x = width == 0 ? 0 : (near - s.physical_from) / width;
      least = gap, best = s.dmx_from + x * (s.dmx_to - s.dmx_from);
    }
  }
  return best;
}

std::optional<double> meaning_of(const std::vector<Segment>& segments, double fraction) {
  if (segments.empty()) return fraction;
  const Segment* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : segments) {
    const double gap = std::abs(fraction - std::clamp(fraction, s.dmx_from, s.dmx_to));
    if (gap < least) least = gap, best = &s;
  }
  if (best == nullptr || best->law == Segment::Law::no_effect) return std::nullopt;
  const double width = best->dmx_to - best->dmx_from;
  const double x = width == 0 || best->law == Segment::Law::neutral
                       ? 0
                       : std::clamp((fraction - best->dmx_from) / width, 0.0, 1.0);
  return best->physical_from + x * (best->physical_to - best->physical_from);
}

}  // namespace chiaro::studio
