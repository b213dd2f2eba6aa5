// SPDX-License-Identifier: Apache-2.0
// Colours that are asked beside the goal: warmth, and terms that look at colour.
#include <algorithm>

#include "controller/design/asked.h"
#include "controller/design/colours.h"
#include "controller/design/nudge_rig.h"

namespace chiaro::design {

studio::Rig with_term_colours(const Setting& setting, const Layers& layers, studio::Rig rig) {
  const Asked& asked = *setting.target.asked;
  if (!wants(*asked.wishes, "cool_warm") && !wants(*asked.wishes, "chroma")) return rig;
  const auto cost = [&](const studio::Rig& tried) {
    const core::Picture colour = predicted(setting.studio, layers, tried, Accuracy::cached);
    const core::Plane light = core::luminance(colour);
    measure::terms::Seen seen = seen_of(asked, light, {}, {});
    seen.colour = &colour;
    return term_cost(asked, seen);
  };
  double best = cost(rig);
  for (const double mired : {80.0, 40.0, 20.0, 10.0})
    for (const std::size_t fixture : setting.variables.lit) {
      const studio::Emitter& emitter = setting.studio.fixtures[fixture].profile.emitter;
      if (!emitter.has_white_mix() || rig.states[fixture].get(core::Dof::intensity) <= 0) continue;
      for (const double step : {mired, mired, -mired, -mired}) {
        studio::Rig tried = rig;
        const double now = rig.states[fixture].get(core::Dof::cct, emitter.cct.value);
        tried.states[fixture].set(core::Dof::cct,
                                  emitter.cct_range.clamp(1e6 / std::max(1.0, 1e6 / now + step)));
        const double here = cost(tried);
        if (here >= best) continue;
        best = here;
        rig = std::move(tried);
      }
    }
  return rig;
}

studio::Rig with_warmth(const studio::Studio& studio, const Layers& layers,
                        const std::vector<std::size_t>& free, const studio::Rig& rig,
                        double mired) {
  if (mired == 0 || free.empty()) return rig;
  studio::Rig neutral = rig;
  for (const std::size_t fixture : free) {
    const studio::Emitter& emitter = studio.fixtures[fixture].profile.emitter;
    if (emitter.has_white_mix() && neutral.states[fixture].has(core::Dof::cct))
      neutral.states[fixture].set(core::Dof::cct,
                                  emitter.cct_range.clamp(studio.exposure.white_balance.value));
  }
  Nudge nudge;
  nudge.warmth = std::clamp(mired / kNudgeMired, -kMostSteps, kMostSteps);
  return nudged_rig({studio, layers, free}, neutral, nudge).rig;
}

}  // namespace chiaro::design
