// SPDX-License-Identifier: Apache-2.0
// The colour of a lamp's light as the balanced camera sees it.
#include "controller/studio/studio.h"

namespace chiaro::studio {
namespace {

/// Each emitter gives its share of the light times its drive; all at 1 is the profile's white.
core::Rgb mixture(const Emitter& emitter, const core::FixtureState& state, core::Kelvin balance) {
  core::Rgb sum;
  double shares = 0;
  for (const Primary& primary : emitter.primaries) {
    shares += primary.share;
    sum = sum + primary.share * state.get(primary.dof, 1) *
                    core::coloured_light(primary.chromaticity, balance);
  }
  return shares > 0 ? (1 / shares) * sum : core::Rgb{1, 1, 1};
}

}  // namespace

core::Rgb light_colour(const Fixture& fixture, const core::FixtureState& state,
                       core::Kelvin balance) {
  const Emitter& emitter = fixture.profile.emitter;
  const auto value = [&](core::Dof dof, double otherwise) {
    return state.get(dof, fixture.initial.get(dof, otherwise));
  };
  switch (emitter.kind) {
    case Emitter::Kind::mixed:
      return mixture(emitter, state, balance);
    case Emitter::Kind::dimmer:  // a gel may give even a plain lamp another colour
      return core::white_light({value(core::Dof::cct, emitter.cct.value)},
                               value(core::Dof::tint, 0), balance);
    case Emitter::Kind::bicolour:
    case Emitter::Kind::blend:
      break;
  }
  const double cct = emitter.cct_range.clamp(balance.value);
  const core::Rgb white =
      core::white_light({value(core::Dof::cct, cct)}, value(core::Dof::tint, 0), balance);
  const double colours =
      emitter.kind == Emitter::Kind::blend ? value(core::Dof::crossfade, 0) : 0;
  return colours <= 0 ? white
                      : (1 - colours) * white + colours * mixture(emitter, state, balance);
}

}  // namespace chiaro::studio
