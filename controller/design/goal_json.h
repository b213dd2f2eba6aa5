// SPDX-License-Identifier: Apache-2.0
// A goal by hand as JSON: what is painted on the predicted picture, what is wished, what must hold.
// config/goals/README.md has the grammar with examples.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/design/paint.h"
#include "controller/design/wishes.h"

namespace chiaro::design {

struct GoalByHand {
  /// What the picture should be like beside what is wished.
  enum class Like { nothing, placed, live, look, mood, exemplar, ideal };
  Like like = Like::nothing;
  std::string name;  ///< the mood's, or the file's (absolute) of a look or an exemplar
  Objective objective = Objective::wavelet;
  std::vector<Stroke> strokes;
  double hold = 1;           ///< see painted()
  std::optional<bool> move;  ///< may stands move; absent: not for what is painted
  std::shared_ptr<Wishes> wishes = std::make_shared<Wishes>();
};

/// Every problem with its place in `text`. `folder`: where files that it names are looked for;
/// absent: it may name none (it came over the network) and may say `live`.
core::Result<GoalByHand> goal_from_json(const std::string& text, const std::string& file,
                                        const studio::Studio& studio,
                                        const std::optional<std::filesystem::path>& folder);

}  // namespace chiaro::design
