// SPDX-License-Identifier: Apache-2.0
#include "tests/support/dmx_decoder.h"

#include <cmath>
#include <cstdlib>
#include <yaml-cpp/yaml.h>

namespace chiaro::support {
namespace {

/// The number at the front of "540 deg", "10 %" or "0.3".
double number(const YAML::Node& node) {
  const auto words = node.as<std::string>();
  return std::atof(words.c_str()) / (words.find('%') != std::string::npos ? 100 : 1);
}

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

/// Least and greatest value of the DOF, as the profile says of the whole lamp.
std::pair<double, double> range_of(const YAML::Node& profile, const std::string& controls) {
  const YAML::Node emitter = profile["emitter"];
  const YAML::Node whites = emitter["bicolour"] ? emitter["bicolour"] : emitter["blend"];
  for (const char* name : {"cct", "tint"})
    if (controls == name && whites && whites[name])
      return {number(whites[name][0]), number(whites[name][1])};
  for (const char* name : {"zoom", "pan", "tilt"})
    if (controls == name && profile[name])
      return {number(profile[name][0]), number(profile[name][1])};
  return {0, 1};
}

struct Meant {
  double value = std::nan(""), step = 0;
};

Meant in_ranges(const YAML::Node& ranges, double raw) {
  for (const YAML::Node& piece : ranges) {
    const double from = number(piece["dmx"][0]), to = number(piece["dmx"][1]);
    if (raw < from || raw > to) continue;
    if (piece["no_effect"]) return {};
    if (piece["neutral"]) return {number(piece["neutral"]), 0};
    const double low = number(piece["means"][0]), high = number(piece["means"][1]);
    const double step = (high - low) / (to - from);
    return {low + (raw - from) * step, std::abs(step)};
  }
  return {};
}

struct Raw {
  double value = 0, most = 0;
};
Raw raw_of(const std::vector<int>& at, std::span<const std::uint8_t> slots) {
  Raw raw;
  for (const int slot : at) {
    raw.value = raw.value * 256 + slots[static_cast<std::size_t>(slot)];
    raw.most = raw.most * 256 + 255;
  }
  return raw;
}

/// Where the channel's bytes stand; `next` is where it stands without a word about it.
std::vector<int> slots_of(const YAML::Node& channel, int next) {
  std::vector<int> at;
  for (const YAML::Node& slot : channel["slots"]) at.push_back(slot.as<int>() - 1);
  if (!at.empty()) return at;
  const int first = channel["slot"] ? channel["slot"].as<int>() - 1 : next;
  const int bytes = channel["bits"] ? channel["bits"].as<int>() / 8 : 1;
  for (int i = 0; i < bytes; ++i) at.push_back(first + i);
  return at;
}

/// The value that the channel gives, before any curve.
Meant meant(const YAML::Node& profile, const YAML::Node& channel, const std::string& controls,
            Raw raw) {
  if (channel["ranges"]) return in_ranges(channel["ranges"], raw.value);
  const auto [low, high] = range_of(profile, controls);
  return {low + raw.value / raw.most * (high - low), (high - low) / raw.most};
}

}  // namespace

std::vector<std::string> modes_in(const std::filesystem::path& profile_file) {
  std::vector<std::string> names;
  for (const auto& mode : YAML::LoadFile(profile_file.string())["modes"])
    names.push_back(mode.first.as<std::string>());
  return names;
}

bool has_head(const std::filesystem::path& profile_file) {
  return static_cast<bool>(YAML::LoadFile(profile_file.string())["pan"]);
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
  int next = 0;
  for (const YAML::Node& channel : channels) {
    DecodedChannel c;
    for (const char* verb : {"controls", "repeats"})
      if (channel[verb]) c.controls = channel[verb].as<std::string>();
    c.at = slots_of(channel, next);
    next = c.at.back() + 1;
    const Meant own = meant(profile, channel, c.controls, raw_of(c.at, slots));
    c.value = own.value;
    c.step = own.step;
    c.whole = !channel["ranges"] && !channel["repeats"];
    decoded.push_back(c);
  }
  // What a trim adds, its channel's value gets.
  for (std::size_t i = 0; i < decoded.size(); ++i)
    if (channels[i]["trims"])
      for (DecodedChannel& c : decoded)
        if (c.controls == channels[i]["trims"].as<std::string>()) {
          const Raw raw = raw_of(decoded[i].at, slots);
          const Meant added = meant(profile, channels[i], c.controls, raw);
          c.value += added.value;
          c.step = added.step;
          c.whole = false;
        }
  for (DecodedChannel& c : decoded)
    if (c.controls == "intensity" || (is_emitter(c.controls) && !has_dimmer)) {
      c.value = through_curve(profile["curve"], std::min(c.value, 1.0));
      c.step *= 2.5;  // the steepest of the curves above
    }
  return decoded;
}

}  // namespace chiaro::support
