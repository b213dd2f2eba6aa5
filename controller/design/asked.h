// SPDX-License-Identifier: Apache-2.0
// Wishes made ready for pictures of one size: what a trial pays for them, and what came of them.
#pragma once

#include "controller/design/trial.h"
#include "controller/design/wishes.h"
#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::design {

/// Immutable; held by the Target of its size.
struct Asked {
  std::shared_ptr<const Wishes> wishes;
  std::vector<core::Plane> masks;  ///< beside wishes->wishes; sum 1
  /// Where a wished highlight's lamp must stand: from `at` towards `lamp`; (0, 0, 0) elsewhere.
  struct Mirror {
    core::Vec3 at, lamp;
  };
  std::vector<Mirror> mirrors;  ///< beside wishes->wishes
  core::Plane curvature;        ///< empty where no shape is known
  measure::PixelMap map;        ///< of the view, for terms
  std::optional<core::Lab> exemplar_chroma;
  /// Another camera's view at this size, made ready like the main one.
  struct Side {
    const Layers& layers;
    Target target;
    measure::PixelMap map;
    double weight = 1;
    std::string name;
  };
  std::vector<Side> sides;
};
/// What terms see of a picture; `levels` and `columns` tell the key's and the fill's light.
measure::terms::Seen seen_of(const Asked& asked, const core::Plane& luminance,
                             const Columns& columns, std::span<const double> levels);
/// Weighted sum of the terms' costs.
double term_cost(const Asked& asked, const measure::terms::Seen& seen);

std::shared_ptr<Asked> asked_of(std::shared_ptr<const Wishes> wishes, const studio::Studio& studio,
                                const Layers& layers, const Goal& goal);

/// What lamps cost by where they stand: shadows and highlights. One per workspace: a lamp's
/// visibility is fetched when it has moved.
class AskedOfPlaces {
 public:
  explicit AskedOfPlaces(const Setting& setting);
  /// Fills what columns have of wishes: highlights, shadows, bounds, other cameras, lux.
  void update(const studio::Rig& rig, Columns& columns);
  /// Share of the region in shadow, or the angle from the mirror direction in radians.
  double measured(const studio::Rig& rig, std::size_t wish);

 private:
  double hidden(const studio::Rig& rig, std::size_t fixture, const core::Plane& mask);
  ShadowShare shadows(const studio::Rig& rig, std::size_t wish);
  Highlight highlight(const studio::Rig& rig, std::size_t wish);
  std::size_t lamp_of(const Wish& wish) const;

  const Setting setting_;
  struct Seen {
    core::FixtureState state;
    core::Plane visible;
  };
  std::vector<Seen> seen_;                         ///< beside the studio's fixtures
  std::vector<std::unique_ptr<Workspace>> sides_;  ///< beside Asked::sides
};

/// Cost of what a picture shows of one wish, 0..1; 0 for wishes about places.
double picture_cost(const Wish& wish, const core::Plane& mask, const core::Plane& luminance);

/// Lux that one lamp alone, at full, throws on a plane at the face that is turned to the camera.
double lux_on_face(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture);

/// Each bound as a line through the levels of `variables.lit`, for lamps placed as in `rig`.
std::vector<LinearBound> linear_bounds(const Wishes& wishes, const studio::Studio& studio,
                                       const Variables& variables, const studio::Rig& rig);

/// What came of every wish and bound, beside what was asked; and the worst cost of a wish.
struct Outcome {
  std::vector<Component> components;
  std::vector<std::string> broken;  ///< bounds that do not hold, in words
  double worst = 0;
};
Outcome outcome_of(const Setting& setting, const studio::Rig& rig, const core::Plane& luminance);

/// The rig with the levels of `variables.lit` moved as little as need be for every bound to hold:
/// what later stages (back light, colour) may have pushed over it.
studio::Rig within_bounds(const Wishes& wishes, const studio::Studio& studio,
                          const Variables& variables, studio::Rig rig);

/// White lamps' colour temperatures for the terms that look at colour; `rig` where none does.
studio::Rig with_term_colours(const Setting& setting, const Layers& layers, studio::Rig rig);

/// The rig with every lamp that can change colour that much warmer than the camera's white.
studio::Rig with_warmth(const studio::Studio& studio, const Layers& layers,
                        const std::vector<std::size_t>& free, const studio::Rig& rig, double mired);

}  // namespace chiaro::design
