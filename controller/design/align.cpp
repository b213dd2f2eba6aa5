// SPDX-License-Identifier: Apache-2.0
#include "controller/design/align.h"

#include <algorithm>
#include <cmath>

#include "controller/optimise/optimiser.h"

namespace chiaro::design {
namespace {

constexpr core::Range kShift{0.25, 0.75}, kSide{0.7, 1.4};
constexpr std::uint64_t kTrials = 500;
constexpr double kBetter = 0.95;

float bilinear(const core::Plane& plane, double x, double y) {
  const auto cell = [](double at, int n) {
    const double inside = std::clamp(at - 0.5, 0.0, n - 1.0);
    const int low = std::min(static_cast<int>(inside), std::max(0, n - 2));
    return std::pair{low, inside - low};
  };
  const auto [x0, fx] = cell(x, plane.size.width);
  const auto [y0, fy] = cell(y, plane.size.height);
  const int x1 = std::min(x0 + 1, plane.size.width - 1),
            y1 = std::min(y0 + 1, plane.size.height - 1);
  const double top = (1 - fx) * plane.at(x0, y0) + fx * plane.at(x1, y0);
  const double bottom = (1 - fx) * plane.at(x0, y1) + fx * plane.at(x1, y1);
  return static_cast<float>((1 - fy) * top + fy * bottom);
}

core::Plane seen_through(const core::Plane& plane, const Window& window, core::Size size) {
  const double side = std::min(plane.size.width, plane.size.height);
  const double left = (plane.size.width - side) / 2, top = (plane.size.height - side) / 2;
  core::Plane out(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      out.at(x, y) =
          bilinear(plane, left + side * (window.x + window.side * ((x + 0.5) / size.width - 0.5)),
                   top + side * (window.y + window.side * ((y + 0.5) / size.height - 0.5)));
  return out;
}

/// Shrunk to about twice the size at which it will be sampled: bilinear steps then skip nothing.
core::Picture shrunk(const core::Picture& picture, core::Size wanted) {
  const int shorter = std::min(picture.size().width, picture.size().height);
  const double factor = 2.0 * wanted.height / shorter;
  if (factor >= 1) return picture;
  return core::resized(
      picture, {std::max(1, static_cast<int>(std::lround(picture.size().width * factor))),
                std::max(1, static_cast<int>(std::lround(picture.size().height * factor)))});
}

}  // namespace

core::Picture seen_through(const core::Picture& exemplar, const Window& window, core::Size size) {
  const core::Picture source = shrunk(exemplar, size);
  core::Picture out;
  out.red = seen_through(source.red, window, size);
  out.green = seen_through(source.green, window, size);
  out.blue = seen_through(source.blue, window, size);
  return out;
}

Window best_window(const core::Picture& exemplar, const core::Plane& ours, std::uint64_t seed) {
  const core::Plane source = core::luminance(shrunk(exemplar, ours.size));
  const auto wanted = measure::haar_spectrum(measure::working_scalar(ours), ours.size.width);
  const auto distance = [&](const Window& window) {
    const auto seen = measure::working_scalar(seen_through(source, window, ours.size));
    return measure::haar_distance(measure::haar_spectrum(seen, ours.size.width), wanted);
  };
  optimise::Task task;
  task.cost = [&](std::span<const double> p) { return distance({p[0], p[1], p[2]}); };
  task.bounds = {kShift, kShift, kSide};
  task.starts = {{0.5, 0.5, 1}};
  task.trials = kTrials;
  task.seed = seed;
  const optimise::Outcome outcome = optimise::make_optimiser("sbplx")->minimise(task);
  if (outcome.value > kBetter * distance({})) return {};
  return {outcome.best[0], outcome.best[1], outcome.best[2]};
}

}  // namespace chiaro::design
