// SPDX-License-Identifier: Apache-2.0
// What each lamp is seen by, remembered on a grid over the places where its mount can put it, and
// blended between neighbours: a search asks thousands of times, and tracing is what to avoid.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "controller/render/lighting.h"
#include "controller/render/view.h"
#include "controller/studio/studio.h"

namespace chiaro::render {

/// Spacing of the grid's places. Azimuth takes wider steps towards the pole, where its circles
/// shrink; distance goes by equal ratios.
struct GridSpacing {
  double angle = core::radians(7.5);
  double ratio = 1.5;
};

/// Thread-safe. A value depends only on the lamp's place and colourless optics, never on what is
/// already cached nor on who asked first: places are filled on first use, tile by tile, by all who
/// need them and by idle threads of their arena, and
/// dropped oldest-used first when over the budget; filled again they come out the same.
class VisibilityCache {
 public:
  /// `view` and `studio` outlive the cache.
  VisibilityCache(const View& view, const studio::Studio& studio, std::size_t budget_bytes,
                  GridSpacing spacing = {});
  ~VisibilityCache();
  VisibilityCache(const VisibilityCache&) = delete;
  VisibilityCache& operator=(const VisibilityCache&) = delete;

  /// The blend for the fixture in that state; fills missing places. Outside its mount's region the
  /// nearest place within counts. A lamp that cannot be moved has one place, traced exactly.
  /// The cache outlives the answer.
  std::unique_ptr<const Visible> at(std::size_t fixture, const core::FixtureState& state) const;

  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chiaro::render
