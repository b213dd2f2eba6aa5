// SPDX-License-Identifier: Apache-2.0
#include "controller/design/levels.h"

#include "controller/design/asked_levels.h"
#include "controller/design/painted_levels.h"
#include "controller/design/pattern.h"
#include "controller/design/perceptual_levels.h"
#include "controller/design/wavelet_levels.h"

namespace chiaro::design {

namespace {

std::unique_ptr<LevelSolver> goal_solver(const Target& target, const measure::PixelMap& map) {
  if (target.kind == Target::Kind::pattern) return std::make_unique<PatternLevels>(*target.pattern);
  if (target.kind == Target::Kind::wavelet) return std::make_unique<WaveletLevels>(target);
  if (target.kind == Target::Kind::painted) return std::make_unique<PaintedLevels>(target);
  return std::make_unique<PerceptualLevels>(target, map);
}

}  // namespace

std::unique_ptr<LevelSolver> level_solver(const Target& target, const measure::PixelMap& map) {
  auto goal = goal_solver(target, map);
  if (!target.asked) return goal;
  return std::make_unique<AskedLevels>(std::move(goal), target, map);
}

double ShadowShare::share(std::span<const double> levels) const {
  double all = constant, dark = hidden_constant;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    all += levels[k] * light[k];
    dark += levels[k] * hidden[k];
  }
  return all > 0 ? dark / all : 1;
}

void mix(const Columns& columns, std::span<const double> levels, core::Plane& out) {
  out = *columns.offset;
  const std::size_t pixels = out.values.size();
  for (std::size_t k = 0; k < columns.planes.size(); ++k) {
    if (levels[k] == 0) continue;
    const auto level = static_cast<float>(levels[k]);
    const float* column = columns.planes[k]->values.data();
    float* sum = out.values.data();
    for (std::size_t i = 0; i < pixels; ++i) sum[i] += level * column[i];
  }
}

}  // namespace chiaro::design
