// SPDX-License-Identifier: Apache-2.0
#include "tests/support/dmx_decoder.h"

#include <cmath>
#include <cstdlib>
#include <yaml-cpp/yaml.h>

namespace chiaro::support {
namespace {

double number(const YAML::Node& node) { return std::atof(node.as<std::string>().c_str()); }

double through_curve(const YAML::Node& curve, double drive) {
  const std::string law = curve.IsScalar() ? curve.as<std::string>() : "gamma";
  if (law == "square") return drive * drive;
  if (law == "s_curve" || law == "s-curve") return drive * drive * (3 - 2 * drive);
  if (law == "gamma") return std::pow(drive, number(curve["gamma"]));
  return drive;
}

bool is_emitter(const std::string& controls) {
  for (const char* name : {"red", "green", "blue", "white", "warm_white", "amber", "lime", "cyan"})
    if (controls == name) return true;
  return false;
}

/// Least and greatest value of the DOF, as the profile's emitter says.
std::pair<double, double> range_of(const YAML::Node& profile, const std::string& controls) {
  const YAML::Node bicolour = profile["emitter"]["bicolour"];
  if (controls == "cct") return {number(bicolour["cct"][0]), number(bicolour["cct"][1])};
  if (controls == "tint") return {number(bicolour["tint"][0]), number(bicolour["tint"][1])};
  return {0, 1};
}

double in_ranges(const YAML::Node& ranges, double raw) {
  for (const YAML::Node& piece : ranges) {
    const double from = number(piece["dmx"][0]), to = number(piece["dmx"][1]);
    if (raw < from || raw > to) continue;
    if (piece["neutral"]) return number(piece["neutral"]);
    const double low = number(piece["means"][0]), high = number(piece["means"][1]);
    return low + (raw - from) / (to - from) * (high - low);
  }
  return std::nan("");
}

}  // namespace

std::vector<std::string> modes_in(const std::filesystem::path& profile_file) {
  std::vector<std::string> names;
  for (const auto& mode : YAML::LoadFile(profile_file.string())["modes"])
    names.push_back(mode.first.as<std::string>());
  return names;
}

std::vector<DecodedChannel> decode_slots(const std::filesystem::path& profile_file,
                                         const std::string& mode,
                                         std::span<const std::uint8_t> slots) {
  const YAML::Node profile = YAML::LoadFile(profile_file.string());
  const YAML::Node channels = profile["modes"][mode];
  bool has_dimmer = false;
  for (const YAML::Node& channel : channels)
    has_dimmer =
        has_dimmer || (channel["controls"] && channel["controls"].as<std::string>() == "intensity");
  std::vector<DecodedChannel> decoded;
  int slot = 0;
  for (const YAML::Node& channel : channels) {
    DecodedChannel c;
    if (channel["controls"]) c.controls = channel["controls"].as<std::string>();
    c.bytes = channel["bits"] ? channel["bits"].as<int>() / 8 : 1;
    c.slot = slot;
    double raw = 0, most = 0;
    for (int i = 0; i < c.bytes; ++i, ++slot) {
      raw = raw * 256 + slots[static_cast<std::size_t>(slot)];
      most = most * 256 + 255;
    }
    const auto [low, high] = range_of(profile, c.controls);
    c.value = low + raw / most * (high - low);
    c.step = (high - low) / most;
    if (channel["ranges"]) {
      c.value = in_ranges(channel["ranges"], raw);
      c.whole = false;
    }
    if (c.controls == "intensity" || (is_emitter(c.controls) && !has_dimmer)) {
      c.value = through_curve(profile["curve"], c.value);
      c.step *= 2.5;  // the steepest of the curves above
    }
    decoded.push_back(c);
  }
  return decoded;
}

}  // namespace chiaro::support
