// SPDX-License-Identifier: Apache-2.0
#include "controller/design/paint.h"

#include <algorithm>
#include <cmath>

#include "controller/design/colours.h"

namespace chiaro::design {
namespace {

/// Light that is so many mired warmer than the camera's white.
core::Rgb warmer(core::Kelvin balance, double mired) {
  if (mired == 0) return {1, 1, 1};
  const double kelvin = 1e6 / (1e6 / balance.value + mired);
  return core::white_light(core::Kelvin{std::clamp(kelvin, 1500.0, 20000.0)}, 0, balance);
}

void lay(const Stroke& stroke, const core::Plane& mask, core::Kelvin balance,
         core::Picture& picture) {
  const core::Rgb warm = warmer(balance, stroke.mired);
  for (int y = 0; y < mask.size.height; ++y)
    for (int x = 0; x < mask.size.width; ++x) {
      const double m = mask.at(x, y);
      if (m <= 0) continue;
      const core::Rgb old = picture.at(x, y);
      const core::Rgb tinted = warm * old;
      const double kept =
          core::luminance(tinted) > 0 ? core::luminance(old) / core::luminance(tinted) : 1;
      const core::Rgb now = (std::exp2(stroke.stops) * kept) * tinted;
      picture.set(x, y, (1 - m) * old + m * now);
    }
}

}  // namespace

ExampleGoal painted(const studio::Studio& studio, const LayersSource& twin, const studio::Rig& rig,
                    const std::vector<Stroke>& strokes, double hold, core::Size size) {
  const Layers& layers = twin.at(size);
  ExampleGoal goal;
  goal.name = "painted";
  goal.objective = Objective::painted;
  goal.exemplar = predicted(studio, layers, rig, Accuracy::exact);
  goal.unpainted = core::luminance(goal.exemplar);
  core::Plane rest(size, 1.0f), emphasis(size);
  for (const Stroke& stroke : strokes) {
    const core::Plane mask = mask_of(stroke.region, studio, layers.geometry(), size);
    lay(stroke, mask, studio.exposure.white_balance, goal.exemplar);
    double sum = 0;
    for (const float m : mask.values) sum += double{m};
    if (sum <= 0) continue;
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
      emphasis.values[i] += static_cast<float>(stroke.strength / sum) * mask.values[i];
      rest.values[i] *= 1 - mask.values[i];
    }
  }
  double left = 0;
  for (const float m : rest.values) left += double{m};
  for (std::size_t i = 0; i < rest.values.size() && left > 0; ++i)
    emphasis.values[i] += static_cast<float>(hold / left) * rest.values[i];
  goal.emphasis = std::move(emphasis);
  goal.follow_colour = std::any_of(strokes.begin(), strokes.end(),
                                   [](const Stroke& stroke) { return stroke.mired != 0; });
  return goal;
}

}  // namespace chiaro::design
