// SPDX-License-Identifier: Apache-2.0
// What a person may ask beside the goal, whatever the goal is: this bright here, no shadow there, a
// highlight on the cheek (Poulin and Fournier 1992), an impression (Flynn; Kawai 1993), bounds that
// must hold.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/result.h"
#include "controller/design/design.h"
#include "controller/design/region.h"

namespace chiaro::design {

/// Each has a cost of 0 (met) to 1; a weight of 1 makes the worst as dear as the goal's own worst.
struct Wish {
  enum class Kind {
    lightness,        ///< mean L* of the region is `wanted`
    spread_at_most,   ///< standard deviation of its L*: even light
    spread_at_least,  ///< the same: light that comes and goes
    no_shadow,        ///< no cast shadow falls on the region
    shadow,           ///< one covers it
    highlight,        ///< the lamp's mirror image stands at the region's centre
  };
  Kind kind = Kind::lightness;
  Region region;
  double wanted = 50;
  double weight = 1;
  std::string lamp;  ///< shadows: of this lamp alone; highlights: its; empty: all, the key's
};

/// What must hold whatever it costs.
struct Bound {
  enum class Kind {
    lux_at_least,   ///< on a plane at the face, turned to the main camera; ambient light counts
    lux_at_most,    ///< the same
    power_at_most,  ///< share of the power of all controlled lamps at full
    level_at_most,  ///< of one lamp
    level_at_least,
  };
  Kind kind = Kind::lux_at_least;
  double limit = 0;
  std::string lamp;  ///< for levels
};

/// A term of measure/picture_terms.def beside the goal.
struct TermShare {
  std::string name;
  double weight = 1;
  std::optional<double> wanted;  ///< nothing: the term's usual
};

/// Another camera that sees the same lamps and must be pleased too, with the same goal.
struct CameraShare {
  std::string name;
  double weight = 1;                         ///< beside the main camera's 1
  std::shared_ptr<const LayersSource> twin;  ///< of that camera; see with_twins()
};

struct Wishes {
  std::vector<Wish> wishes;
  std::vector<Bound> bounds;
  std::vector<TermShare> terms;
  std::vector<CameraShare> cameras;
  double warmth_mired = 0;  ///< colour of all lamps from the camera's white, + warmer
  bool empty() const {
    return wishes.empty() && bounds.empty() && terms.empty() && cameras.empty() &&
           warmth_mired == 0;
  }
};

bool wants(const Wishes& wishes, std::string_view term);

/// An impression as what can be measured: impressions.def has them and where they come from.
struct Impression {
  std::string_view name, summary;
  void (*add)(Wishes& wishes, double weight);
};
std::span<const Impression> impressions();

/// Unknown lamps, bounds that contradict each other, regions without a pixel.
core::Problems problems_of(const Wishes& wishes, const studio::Studio& studio,
                           const Layers& layers);

/// "lightness of the face", "no shadow of key on a rectangle": as results name them.
std::string in_words(const Wish& wish);
std::string in_words(const Bound& bound);

}  // namespace chiaro::design
