// SPDX-License-Identifier: Apache-2.0
// A show as a studio file.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "controller/importers/show.h"

namespace chiaro::importers {
namespace {

constexpr double kAimHeight = 1.25;

/// A half circle before the subject, from camera left to camera right.
core::Vec3 guessed_place(std::size_t i, std::size_t count) {
  const double turn = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.5;
  const double azimuth = core::radians(-80 + 160 * turn);
  return {2.5 * std::sin(azimuth), -2.5 * std::cos(azimuth), 2.4};
}

std::string point(core::Vec3 p) { return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", p.x, p.y, p.z); }

/// Keys must be strings even where a name looks like a number.
std::string quoted(const std::string& name) { return "\"" + name + "\""; }

std::string lamp_yaml(const ShowLamp& lamp, std::size_t i, std::size_t count) {
  constexpr std::array kRoles{"key", "fill", "back"};
  const core::Vec3 at = lamp.at.value_or(guessed_place(i, count));
  core::Vec3 aim = lamp.direction ? at + 2.0 * *lamp.direction : core::Vec3{0, 0, kAimHeight};
  if (core::distance(at, aim) < 0.01) aim = at + core::Vec3{0, 0, -1};
  std::string mode = lamp.mode;
  for (std::size_t from = 0; (from = mode.find_first_of("\"\\", from)) != std::string::npos;
       from += 2)
    mode.insert(from, "\\");
  return fmt::format(
      "  {}:\n    role: {}\n    profile: {}\n    mode: \"{}\"\n"
      "    mount: {{{}: {{at: {}, aim_at: {}}}}}\n    patch: {{universe: {}, address: {}}}\n",
      quoted(lamp.name), i < kRoles.size() ? kRoles[i] : "background", lamp.profile, mode,
      lamp.has_head ? "pan_tilt" : "fixed", point(at), point(aim), lamp.universe, lamp.address);
}

}  // namespace

std::string studio_yaml(const Show& show, const std::string& origin) {
  std::string clean;
  for (const char c : origin.substr(0, 80)) clean += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  const bool places = std::all_of(show.lamps.begin(), show.lamps.end(),
                                  [](const ShowLamp& lamp) { return lamp.at.has_value(); });
  std::string text = "# From " + clean + ". Roles, subject and camera are guesses: correct them.\n";
  if (!places)
    text += "# The show has no places: the lamps stand in a half circle. Correct them too.\n";
  text +=
      "studio: imported show\n"
      "subject: {stand_in: person, eye_height: 1.25 m, at: [0, 0, 0]}\n"
      "cameras:\n"
      "  main: {at: [0, -2.6, 1.25], look_at: [0, 0, 1.25], vertical_fov: 22 deg, lamps_may_show: "
      "yes}\n"
      "fixtures:\n";
  std::set<int> universes;
  for (std::size_t i = 0; i < show.lamps.size(); ++i) {
    text += lamp_yaml(show.lamps[i], i, show.lamps.size());
    universes.insert(show.lamps[i].universe);
  }
  text += "outputs:\n";
  for (const int universe : universes) text += fmt::format("  universe {}: mock\n", universe);
  text += "exposure: {grey_card: 800 lx, white_balance: 5600 K}\n";
  return text;
}

}  // namespace chiaro::importers
