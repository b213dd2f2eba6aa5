// SPDX-License-Identifier: Apache-2.0
#include "controller/design/words.h"

#include <algorithm>
#include <cmath>

#include "controller/design/design.h"
#include "controller/design/starts.h"
#include "controller/design/variables.h"
#include "controller/twin/scene.h"

namespace chiaro::design {
namespace {

// A stand this near to where it should be is left alone.
const double kSameAngle = core::radians(2);
constexpr double kSameDistance = 0.05;
constexpr double kSameKelvin = 75, kSameLevel = 0.01;

core::Spherical place_of(const core::FixtureState& state) {
  return {state.get(core::Dof::azimuth), state.get(core::Dof::elevation),
          state.get(core::Dof::distance, 1)};
}

bool same_place(const core::Spherical& a, const core::Spherical& b) {
  return std::abs(std::remainder(a.azimuth - b.azimuth, 2 * core::kPi)) < kSameAngle &&
         std::abs(a.elevation - b.elevation) < kSameAngle &&
         std::abs(a.distance - b.distance) < kSameDistance;
}

std::string by_hand(const studio::Fixture& fixture, const studio::HandBinding& binding,
                    const core::FixtureState& now, const core::FixtureState& wanted) {
  const double value = wanted.get(binding.dof);
  const double change = std::abs(value - now.get(binding.dof));
  switch (binding.kind) {
    case studio::HandKind::knob:
      if (binding.dof == core::Dof::cct)
        return change < kSameKelvin
                   ? ""
                   : "set " + fixture.name + "'s colour to " + number(value, 0) + " K";
      return change < kSameLevel
                 ? ""
                 : "set " + fixture.name + "'s " +
                       (binding.dof == core::Dof::intensity ? "knob"
                                                            : std::string(info(binding.dof).name)) +
                       " to " + level_in_words(value);
    case studio::HandKind::gel:
      return change < kSameKelvin
                 ? ""
                 : "put a gel on " + fixture.name + " that makes it " + number(value, 0) + " K";
    case studio::HandKind::flash_power:
      return change < kSameLevel ? ""
                                 : "set " + fixture.name + " to " + flash_power_in_words(value);
    case studio::HandKind::stand:
      return "";  // said once for the whole stand
  }
  return "";
}

}  // namespace

std::vector<std::string> instructions(const studio::Studio& studio, const studio::Rig& now,
                                      const studio::Rig& wanted) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const studio::Fixture& fixture = studio.fixtures[i];
    const bool stand = std::holds_alternative<studio::StandMount>(fixture.mount);
    const core::Spherical to = place_of(wanted.states[i]);
    const std::string place = place_in_words(to);  // "47° camera left", "at the camera's azimuth"
    if (stand && !same_place(place_of(now.states[i]), to))
      result.push_back("move " + fixture.name + (place.starts_with("at ") ? " " : " to ") + place +
                       " from the face");
    for (const studio::HandBinding& binding : fixture.by_hand) {
      const std::string words = by_hand(fixture, binding, now.states[i], wanted.states[i]);
      if (!words.empty()) result.push_back(words);
    }
  }
  return result;
}

double lux_at_face(const studio::Studio& studio, const studio::Rig& rig, std::size_t fixture) {
  const studio::Fixture& lamp = studio.fixtures[fixture];
  const core::FixtureState& state = rig.states[fixture];
  const core::AimFrame aim = estimated_aim(studio);
  const double distance = core::distance(twin::pose(lamp, state, aim).position, aim.origin);
  const double colour =
      core::luminance(studio::light_colour(lamp, state, studio.exposure.white_balance));
  return state.get(core::Dof::intensity) * colour * lamp.fitted_output().value /
         std::max(distance * distance, 1e-6);
}

std::optional<double> key_fill_ratio(const studio::Studio& studio, const studio::Rig& rig) {
  double key = 0, fill = 0;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    if (studio.fixtures[i].role == studio::Role::key) key += lux_at_face(studio, rig, i);
    if (studio.fixtures[i].role == studio::Role::fill) fill += lux_at_face(studio, rig, i);
  }
  // A lamp a thousand times weaker than the other is dark to any meter.
  if (key <= fill * 1e-3 || fill <= key * 1e-3) return std::nullopt;
  return key / fill;
}

std::string ratio_in_words(const studio::Studio& studio, const studio::Rig& rig) {
  const auto ratio = key_fill_ratio(studio, rig);
  if (!ratio) return "";
  const double more = std::max(*ratio, 1 / *ratio);
  return (*ratio >= 1 ? "key to fill " : "fill to key ") + number(more, more < 10 ? 1 : 0) +
         ":1 (" + stops_in_words(std::log2(more)) + ")";
}

bool is_flash(const studio::Fixture& fixture) {
  return std::any_of(fixture.by_hand.begin(), fixture.by_hand.end(), [](const auto& binding) {
    return binding.kind == studio::HandKind::flash_power && binding.dof == core::Dof::intensity;
  });
}

std::string mixed_light_in_words(const studio::Studio& studio, const studio::Rig& rig) {
  std::string flashes, burning;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    if (rig.states[i].get(core::Dof::intensity) <= 0) continue;
    std::string& names = is_flash(studio.fixtures[i]) ? flashes : burning;
    names += (names.empty() ? "" : ", ") + studio.fixtures[i].name;
  }
  if (flashes.empty() || burning.empty()) return "";
  const auto& shutter = studio.main_camera().shutter_s;
  return "flash (" + flashes + ") and continuous light (" + burning +
         ") are lit together: a longer shutter brightens the second alone, so keep it at " +
         (shutter ? core::shutter_in_words(*shutter)
                  : std::string("the time for which the outputs were measured")) +
         ", or light with one kind";
}

}  // namespace chiaro::design
