// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/interview/learnt.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

namespace chiaro::daemon::interview {
namespace {

/// What common LEDs are: a starting point that the person may edit in the file.
struct Common {
  const char* colour;  ///< of the emitter, as the profile says it
  double share;        ///< beside the others, before they are made to add up to 1
};
const std::map<std::string, Common>& drives() {
  static const std::map<std::string, Common> kDrives{
      {"red", {"chromaticity: [0.690, 0.308]", 0.21}},
      {"green", {"chromaticity: [0.170, 0.700]", 0.44}},
      {"blue", {"chromaticity: [0.140, 0.045]", 0.05}},
      {"white", {"cct: 5600 K", 0.5}},
      {"warm_white", {"cct: 3000 K", 0.45}},
      {"amber", {"chromaticity: [0.570, 0.420]", 0.2}},
      {"lime", {"chromaticity: [0.400, 0.540]", 0.5}},
      {"cyan", {"chromaticity: [0.090, 0.380]", 0.2}}};
  return kDrives;
}

bool any(const LearntLamp& lamp, const std::string& seen) {
  return std::any_of(lamp.slots.begin(), lamp.slots.end(),
                     [&](const LearntSlot& slot) { return slot.sees == seen; });
}

/// The emitters that answer to slots of their own, in the order of the slots.
std::vector<std::string> drives_of(const LearntLamp& lamp) {
  std::vector<std::string> found;
  for (const LearntSlot& slot : lamp.slots)
    if (drives().count(slot.sees) > 0) found.push_back(slot.sees);
  return found;
}

/// One white alone is a dimmer by another name.
bool is_dimmer(const LearntLamp& lamp) {
  const auto found = drives_of(lamp);
  return found.size() == 1 && (found[0] == "white" || found[0] == "warm_white") &&
         !any(lamp, "dimmer");
}

std::string kelvin(double value) { return fmt::format("{:.0f} K", value); }

std::string emitter(const LearntLamp& lamp) {
  const auto found = drives_of(lamp);
  const std::string middle = kelvin((lamp.cct.least + lamp.cct.most) / 2);
  if (found.empty() && any(lamp, "cct"))
    return fmt::format("{{bicolour: {{cct: [{}, {}]{}}}}}", kelvin(lamp.cct.least),
                       kelvin(lamp.cct.most), any(lamp, "tint") ? ", tint: [-10, 10]" : "");
  if (found.empty() || is_dimmer(lamp)) return "{dimmer: {cct: " + middle + "}}";
  double sum = 0;
  for (const std::string& name : found) sum += drives().at(name).share;
  std::string text = "\n  mixed:";
  double left = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    // Shares add up to 1 as they are printed.
    const double exact = drives().at(found[i]).share / sum;
    const double share = i + 1 == found.size() ? left : std::round(1000 * exact) / 1000;
    left -= share;
    text += fmt::format("\n    {}: {{{}, share: {:.3f}}}", found[i], drives().at(found[i]).colour,
                        share);
  }
  return text;
}

bool is_constant(const LearntLamp& lamp, const std::string& sees) {
  const bool white = !drives_of(lamp).empty();
  return sees == "nothing" || sees == "keep" || sees == "pan" || sees == "tilt" ||
         ((sees == "cct" || sees == "tint") && white) || (sees == "tint" && !any(lamp, "cct"));
}

std::string constant(const LearntSlot& slot, std::size_t number) {
  const std::string name = slot.sees == "nothing" ? "unused" : slot.sees;
  return fmt::format("    - {{name: {} {}, constant: {}}}\n", name, number,
                     slot.sees == "keep" ? slot.level : 0);
}

core::Problem unclear(std::string what, std::string remedy) {
  return {{}, std::move(what), std::move(remedy), false};
}

core::Problems faults(const LearntLamp& lamp) {
  core::Problems problems;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < lamp.slots.size(); ++i) {
    const std::string& sees = lamp.slots[i].sees;
    if (sees == "fine" && (i == 0 || lamp.slots[i - 1].sees == "nothing"))
      problems.push_back(unclear(fmt::format("slot {} cannot be the fine half of nothing", i + 1),
                                 "say what the slot before it does"));
    const bool repeatable = sees == "fine" || sees == "nothing" || sees == "keep";
    if (!repeatable && !seen.insert(sees).second)
      problems.push_back(unclear(fmt::format("two slots are said to be '{}'", sees),
                                 "learn a lamp with several heads as several lamps"));
  }
  if (!any(lamp, "dimmer") && drives_of(lamp).empty())
    problems.push_back(unclear("no slot gave light", "raise each slot and say what you see"));
  return problems;
}

std::string channels(const LearntLamp& lamp) {
  std::string text;
  for (std::size_t i = 0; i < lamp.slots.size(); ++i) {
    const LearntSlot& slot = lamp.slots[i];
    if (is_constant(lamp, slot.sees)) {
      text += constant(slot, i + 1);
      // Its fine half, if it has one, rests too.
      if (i + 1 < lamp.slots.size() && lamp.slots[i + 1].sees == "fine")
        text += constant({"nothing"}, ++i + 1);
      continue;
    }
    int bits = 8;
    while (bits < 24 && i + 1 < lamp.slots.size() && lamp.slots[i + 1].sees == "fine") {
      bits += 8;
      ++i;
    }
    const bool level = slot.sees == "dimmer" || (is_dimmer(lamp) && drives().count(slot.sees) > 0);
    text += fmt::format("    - {{controls: {}{}}}\n", level ? "intensity" : slot.sees,
                        bits == 8 ? "" : fmt::format(", bits: {}", bits));
  }
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool opens_fixtures(const std::string& line) {
  constexpr std::string_view kHead = "fixtures:";
  if (!line.starts_with(kHead)) return false;
  const auto after = line.find_first_not_of(" \t\r", kHead.size());
  return after == std::string::npos || line[after] == '#';
}

/// How far the first entry of these lines stands in.
std::size_t indent_after(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const auto first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] == '#' || line[first] == '\r') continue;
    return std::max<std::size_t>(first, 1);
  }
  return 2;
}

/// A block that stands in by two, standing in by `indent`: only its first level must agree.
std::string indented(const std::string& block, std::size_t indent) {
  std::string out;
  for (const std::string& line : lines_of(block)) {
    const auto depth = line.find_first_not_of(' ');
    if (depth == std::string::npos) continue;
    out +=
        std::string(indent + std::max<std::size_t>(depth, 2) - 2, ' ') + line.substr(depth) + "\n";
  }
  return out;
}

}  // namespace

std::string profile_name(const std::string& lamp) {
  std::string name;
  for (const char c : lamp) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte))
      name += static_cast<char>(std::tolower(byte));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return "own/" + (name.empty() ? "lamp" : name);
}

core::Result<std::string> profile_yaml(const LearntLamp& lamp) {
  if (core::Problems problems = faults(lamp); !problems.empty()) return problems;
  const auto quoted = [](const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
      if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 32) out += c;
    return out + "\"";
  };
  return fmt::format(
      "# Learned by raising its slots. Output, colours and shares are guesses to begin with: a\n"
      "# light meter or the data sheet knows better.\n"
      "profile: {}\nmaker: {}\nmodel: {}\noutput: {:.0f} cd\n"
      "optic: {{rectangle: [0.30, 0.30]}}\nemitter: {}\n{}modes:\n  {}:\n{}",
      lamp.profile, quoted(lamp.maker), quoted(lamp.model), lamp.output_cd, emitter(lamp),
      any(lamp, "zoom") ? "zoom: [10 deg, 50 deg]\n" : "", kLearntMode, channels(lamp));
}

core::Result<std::string> with_fixture(const std::string& yaml, const std::string& entry) {
  const std::vector<std::string> lines = lines_of(yaml);
  const auto head = std::find_if(lines.begin(), lines.end(), opens_fixtures);
  if (head == lines.end())
    return unclear("the studio file has no line 'fixtures:' to add the lamp below",
                   "put the lamp's lines into it by hand");
  std::string out;
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    out += *line + "\n";
    if (line == head) out += indented(entry, indent_after({head + 1, lines.end()}));
  }
  return out;
}

}  // namespace chiaro::daemon::interview
