// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "controller/core/light_units.h"

namespace chiaro::daemon {

std::string level_in_words(double intensity) {
  if (intensity < kOff) return "off";
  if (intensity >= 0.995) return "full";
  const double stops = -core::to_stops(intensity);
  const std::string percent = intensity < 0.095 ? fmt::format("{:.1f} %", 100 * intensity)
                                                : fmt::format("{:.0f} %", 100 * intensity);
  return fmt::format("{}, {:.1f} {} below full", percent, stops,
                     std::fabs(stops - 1) < 0.05 ? "stop" : "stops");
}

std::string colour_in_words(const studio::Fixture& fixture, const core::FixtureState& state) {
  using Kind = studio::Emitter::Kind;
  const bool white = state.get(core::Dof::crossfade) < 0.5;
  if (fixture.profile.emitter.has_white_mix() && white && state.has(core::Dof::cct)) {
    std::string words = fmt::format("{:.0f} K", std::round(state.get(core::Dof::cct) / 10) * 10);
    const double tint = state.get(core::Dof::tint);
    if (std::fabs(tint) >= 0.5)
      words += fmt::format(", {:.0f} towards {}", std::fabs(tint), tint > 0 ? "green" : "magenta");
    return words;
  }
  std::string words;
  if (fixture.profile.emitter.kind != Kind::mixed && white) return words;
  for (const studio::Primary& primary : fixture.profile.emitter.primaries) {
    const double drive = state.get(primary.dof);
    if (drive < 0.005) continue;
    std::string name(core::info(primary.dof).name);
    if (const auto line = name.find('_'); line != std::string::npos) name[line] = ' ';
    words += fmt::format("{}{} {:.0f} %", words.empty() ? "" : ", ", name, 100 * drive);
  }
  return words;
}

std::string ratio_in_words(double ratio) {
  const double shown = ratio < 10 ? std::round(10 * ratio) / 10 : std::round(ratio);
  return fmt::format("{:g}:1", shown);
}

std::string gel_in_words(double from_k, double to_k) {
  struct Gel {
    double mired;
    const char* name;
  };
  // Shifts in mired as Lee Filters print them.
  static constexpr Gel kGels[] = {{159, "full CTO (Lee 204)"}, {124, "¾ CTO (Lee 285)"},
                                  {109, "½ CTO (Lee 205)"},    {64, "¼ CTO (Lee 206)"},
                                  {26, "⅛ CTO (Lee 223)"},     {0, ""},
                                  {-18, "⅛ CTB (Lee 218)"},    {-35, "¼ CTB (Lee 203)"},
                                  {-78, "½ CTB (Lee 202)"},    {-137, "full CTB (Lee 201)"}};
  const double wanted = 1e6 / to_k - 1e6 / from_k;
  return std::min_element(std::begin(kGels), std::end(kGels),
                          [&](const Gel& a, const Gel& b) {
                            return std::fabs(a.mired - wanted) < std::fabs(b.mired - wanted);
                          })
      ->name;
}

std::string hand_in_words(const studio::Fixture& fixture, const studio::HandBinding& binding,
                          double value) {
  const std::string& name = fixture.name;
  const bool kelvin = binding.dof == core::Dof::cct;
  if (binding.kind == studio::HandKind::flash_power)
    return "set " + name + " to " + core::flash_power_in_words(value);
  if (binding.kind == studio::HandKind::gel && kelvin) {
    const std::string gel = gel_in_words(fixture.profile.emitter.cct.value, value);
    return gel.empty() ? "take the gel off " + name
                       : fmt::format("put {} on {}, for {:.0f} K", gel, name, value);
  }
  if (binding.kind == studio::HandKind::gel)
    return fmt::format("put a {} gel on {} ({:+.0f})", value > 0 ? "green" : "magenta", name,
                       value);
  if (kelvin) return fmt::format("turn {}'s colour to {:.0f} K", name, value);
  if (binding.dof == core::Dof::intensity)
    return fmt::format("turn {}'s level to {}", name, core::level_in_words(value));
  return fmt::format("turn {}'s {} to {}", name, core::info(binding.dof).name,
                     core::number(core::file_value(binding.dof, value), 2));
}

std::string_view mount_name(const studio::Mount& mount) {
  static constexpr std::string_view kNames[] = {"fixed", "stand",    "arc",
                                                "track", "pan_tilt", "virtual"};
  return kNames[mount.index()];
}

core::Spherical place_of(const studio::Studio& studio, const studio::Fixture& fixture,
                         const core::FixtureState& placed) {
  if (placed.has(core::Dof::azimuth))
    return {placed.get(core::Dof::azimuth), placed.get(core::Dof::elevation),
            placed.get(core::Dof::distance, 1)};
  core::Vec3 at, aim;
  if (const auto* fixed = std::get_if<studio::FixedMount>(&fixture.mount))
    at = fixed->at, aim = fixed->aim_at;
  else if (const auto* head = std::get_if<studio::PanTiltMount>(&fixture.mount))
    at = head->at, aim = head->aim_at;
  else if (const auto* arc = std::get_if<studio::ArcMount>(&fixture.mount))
    at = arc->centre, aim = studio.main_camera().look_at;
  else if (const auto* track = std::get_if<studio::TrackMount>(&fixture.mount))
    at = track->from + track->at * (track->to - track->from), aim = studio.main_camera().look_at;
  return core::spherical(core::aim_frame(aim, studio.main_camera().at), at);
}

}  // namespace chiaro::daemon
