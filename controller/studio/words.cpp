// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/words.h"

#include <cmath>
#include <cstdio>

#include "controller/studio/reading/text.h"

namespace chiaro::studio {
namespace {

std::string rounded(double value, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  // -0 is no direction.
  const std::string out = text;
  return out.find_first_of("123456789") == std::string::npos && out.front() == '-' ? out.substr(1)
                                                                                   : out;
}

std::string per_cent(double fraction) { return rounded(100 * fraction, 0) + " %"; }

std::string slots(int first, int last, int digits) {
  char text[40];
  if (last > first)
    std::snprintf(text, sizeof text, "%0*d-%0*d", digits, first, digits, last);
  else
    std::snprintf(text, sizeof text, "%0*d", digits, first);
  return text;
}

}  // namespace

std::string place_in_words(const core::Spherical& place) {
  const double azimuth = core::degrees(place.azimuth), elevation = core::degrees(place.elevation);
  const std::string aside = rounded(std::abs(azimuth), 0), above = rounded(std::abs(elevation), 0);
  std::string words;
  if (aside == "0")
    words = "straight in front";
  else if (aside == "180")
    words = "straight behind";
  else
    words = aside + "° camera " + (azimuth < 0 ? "left" : "right") +
            (std::abs(azimuth) > 90 ? " (behind)" : "");
  words += above == "0" ? ", level" : ", " + above + "° " + (elevation < 0 ? "down" : "up");
  return words + ", " + rounded(place.distance, 2) + " m";
}

std::string_view name_of(const Mount& mount) {
  constexpr std::string_view kKinds[] = {"fixed", "stand",       "arc",
                                         "track", "moving head", "virtual"};
  static_assert(std::variant_size_v<Mount> == std::size(kKinds));
  return kKinds[mount.index()];
}

std::string patch_in_words(const Fixture& fixture) {
  const int more = fixture.footprint() - 1;
  if (const auto* dmx = std::get_if<DmxPatch>(&fixture.patch))
    return std::to_string(dmx->universe) + "." + slots(dmx->address, dmx->address + more, 3);
  if (const auto* bus = std::get_if<ModbusPatch>(&fixture.patch))
    return bus->bus + ": " + slots(bus->register_number, bus->register_number + more, 1);
  if (!fixture.controlled) return "not controlled";
  return std::holds_alternative<VirtualMount>(fixture.mount) ? "virtual" : "by hand";
}

std::string output_in_words(const Fixture& fixture) {
  const std::string candela = rounded(fixture.fitted_output().value, 0) + " cd";
  if (fixture.modifiers.empty()) return candela;
  const Modifier& fitted = fixture.modifiers.front();
  if (fitted.width <= 0) return candela + ", bare";
  return candela + ", " + fitted.name + " " + reading::digits(fitted.width) + " x " +
         reading::digits(fitted.height) + " m";
}

std::string limits_in_words(const Limits& limits) {
  std::string words;
  const auto add = [&](const std::string& each) { words += (words.empty() ? "" : ", ") + each; };
  if (limits.most < 1) add("at most " + per_cent(limits.most));
  if (limits.slew_per_s > 0)
    add("dark to full in " + reading::digits(1 / limits.slew_per_s) + " s");
  if (limits.safe_level > 0) add("safe at " + per_cent(limits.safe_level));
  if (limits.end_to_end_s != Limits{}.end_to_end_s)
    add("axes end to end in " + reading::digits(limits.end_to_end_s) + " s");
  if (limits.ignores_blackout) add("house light: stays on in blackout");
  return words.empty() ? "none" : words;
}

std::string_view name_of(HandKind kind) {
  switch (kind) {
    case HandKind::knob:
      return "knob";
    case HandKind::gel:
      return "gel";
    case HandKind::flash_power:
      return "flash power";
    case HandKind::stand:
      return "stand";
  }
  return "";
}

std::string by_hand_in_words(const Fixture& fixture) {
  std::string words;
  for (const HandBinding& binding : fixture.by_hand)
    if (binding.kind != HandKind::stand)
      words += (words.empty() ? "" : ", ") + std::string(core::info(binding.dof).name) + " by " +
               std::string(name_of(binding.kind));
  return words;
}

}  // namespace chiaro::studio
