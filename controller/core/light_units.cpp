// SPDX-License-Identifier: Apache-2.0
#include "controller/core/light_units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace chiaro::core {
namespace {

constexpr int kWeakestFlash = 7;  // stops below full: 1/128

/// Apertures as lenses show them, in thirds from f/1; the engraved numbers are rounded by custom.
constexpr std::array<double, 37> kApertures{
    1, 1.1, 1.2, 1.4, 1.6, 1.8, 2,  2.2, 2.5, 2.8, 3.2, 3.5, 4,  4.5, 5,  5.6, 6.3, 7.1, 8,
    9, 10,  11,  13,  14,  16,  18, 20,  22,  25,  29,  32,  36, 40,  45, 51,  57,  64};

const char* third(int thirds) {
  static constexpr const char* kThird[] = {"", "⅓", "⅔"};
  return kThird[thirds % 3];
}

/// To that many significant figures.
double rounded(double value, int figures) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double step = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - figures);
  return std::round(value / step) * step;
}

std::string significant(double value, int figures) {
  const double tidy = rounded(value, figures);
  const int whole = tidy == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(tidy)))) + 1;
  return number(tidy, std::max(0, figures - whole));
}

bool is_space(char c) { return c == ' ' || c == ',' || c == '\t' || c == ';'; }

/// Lower case, words split at spaces and commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (!is_space(c))
      words.back() += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The positive number at the front of `word`, which is cut off.
std::optional<double> take_number(std::string_view& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || !(value > 0) || !std::isfinite(value)) return std::nullopt;
  word.remove_prefix(static_cast<std::size_t>(end - word.data()));
  return value;
}

std::optional<double> whole_number(std::string_view word) {
  const auto value = take_number(word);
  return word.empty() ? value : std::nullopt;
}

/// "1/50", "1/50s", "0.5s".
std::optional<double> shutter(std::string_view word) {
  if (!word.empty() && word.back() == 's') word.remove_suffix(1);
  const auto value = take_number(word);
  if (!value || word.empty()) return value;
  if (word.front() != '/') return std::nullopt;
  const auto below = whole_number(word.substr(1));
  return below ? std::optional(*value / *below) : std::nullopt;
}

bool starts_with(std::string_view word, std::string_view start) {
  return word.substr(0, start.size()) == start;
}

std::optional<Lux> illuminance(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += word;
  std::string_view rest = joined;
  const auto value = take_number(rest);
  if (!value) return std::nullopt;
  if (rest == "lx" || rest == "lux") return Lux{*value};
  if (rest == "klx") return Lux{1000 * *value};
  if (rest == "fc" || rest == "footcandles" || rest == "foot-candles")
    return lux_of_foot_candles(*value);
  return std::nullopt;
}

}  // namespace

double foot_candles(Lux light) { return light.value * kMetresPerFoot * kMetresPerFoot; }
Lux lux_of_foot_candles(double foot_candles) {
  return {foot_candles / (kMetresPerFoot * kMetresPerFoot)};
}
double feet(double metres) { return metres / kMetresPerFoot; }

Lux lux_for(const CameraSetting& s) {
  return {kIncidentConstant * s.aperture_f * s.aperture_f / (s.shutter_s * s.iso)};
}

double aperture_for(Lux light, double shutter_s, double iso) {
  return std::sqrt(std::max(0.0, light.value) * shutter_s * iso / kIncidentConstant);
}

double lux_seconds_for(double aperture_f, double iso) {
  return kIncidentConstant * aperture_f * aperture_f / iso;
}

Candela candela_from(Lux reading, double distance_m) {
  return {reading.value * distance_m * distance_m};
}
Candela candela_from(const CameraSetting& reading, double distance_m) {
  return candela_from(lux_for(reading), distance_m);
}

bool near_field(double distance_m, double lamp_size_m) { return distance_m < 5 * lamp_size_m; }

std::optional<double> stops_below_full(double level) {
  if (level <= 0) return std::nullopt;
  return std::max(0.0, -std::log2(level));
}

std::vector<double> flash_powers() {
  std::vector<double> powers;
  for (int thirds = 0; thirds <= 3 * kWeakestFlash; ++thirds)
    powers.push_back(std::exp2(-thirds / 3.0));
  return powers;
}

std::optional<double> nearest_flash_power(double level) {
  if (level <= 0) return std::nullopt;
  const long thirds = std::max(0L, std::lround(-3 * std::log2(level)));
  if (thirds > 3 * kWeakestFlash) return std::nullopt;
  return std::exp2(-static_cast<double>(thirds) / 3);
}

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string result = text;
  if (result.find('.') != std::string::npos) {
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string stops_in_words(double stops) {
  const int thirds = static_cast<int>(std::lround(std::abs(stops) * 3));
  std::string words = thirds / 3 > 0 || thirds == 0 ? std::to_string(thirds / 3) : "";
  words += third(thirds);
  return words + (thirds > 0 && thirds <= 3 ? " stop" : " stops");
}

std::string level_in_words(double level) {
  return level >= 0.995 ? "full" : number(100 * level, level < 0.1 ? 1 : 0) + " %";
}

std::string level_and_stops(double level) {
  if (level <= 0.0005) return "dark";
  const double below = *stops_below_full(level);
  // A sixth of a stop rounds to none: "full" and 90 % are the same to a meter.
  if (below < 1.0 / 6) return level_in_words(level);
  return level_in_words(level) + " (" + stops_in_words(below) + " below full)";
}

std::string flash_power_in_words(double level) {
  const auto power = nearest_flash_power(level);
  if (!power) return "off";
  const int thirds = static_cast<int>(std::lround(-3 * std::log2(*power)));
  if (thirds == 0) return "full power";
  const std::string whole = thirds < 3 ? "1/1" : "1/" + std::to_string(1 << (thirds / 3));
  return whole + (thirds % 3 != 0 ? std::string(" - ") + third(thirds) : "") + " power";
}

std::string illuminance_in_words(Lux light) {
  return significant(light.value, 3) + " lx (" + significant(foot_candles(light), 2) + " fc)";
}

std::string white_in_words(Kelvin cct, double tint) {
  const std::string kelvin = number(std::round(cct.value / 10) * 10, 0) + " K";
  const double green = std::round(tint);
  if (green == 0) return kelvin;
  return kelvin + (green > 0 ? ", +" : ", ") + number(green, 0) + " green" +
         (green < 0 ? " (magenta)" : "");
}

std::string ratio_in_words(double ratio) {
  const double more = std::max(ratio, 1 / ratio);
  const std::string stops = stops_in_words(std::log2(more));
  return number(more, more < 10 ? 1 : 0) + ":1 (" + (stops == "0 stops" ? "even" : stops) + ")";
}

std::string distance_in_words(double metres) {
  const int inches = static_cast<int>(std::lround(12 * feet(metres)));
  std::string foot = inches >= 12 ? std::to_string(inches / 12) + " ft" : "";
  if (inches % 12 != 0 || foot.empty())
    foot += (foot.empty() ? "" : " ") + std::to_string(inches % 12) + " in";
  return number(metres, 2) + " m (" + foot + ")";
}

std::string azimuth_in_words(double azimuth) {
  const double turn = degrees(std::remainder(azimuth, 2 * kPi));
  if (std::abs(turn) < 0.5) return "at the camera's azimuth";
  if (std::abs(turn) > 179.5) return "straight behind";
  return number(std::abs(turn), 0) + "° camera " + (turn < 0 ? "left" : "right");
}

std::string elevation_in_words(double elevation) {
  const double rise = degrees(elevation);
  return number(std::abs(rise), 0) + "° " + (rise < -0.5 ? "down" : "up");
}

std::string place_in_words(const Spherical& place) {
  return azimuth_in_words(place.azimuth) + ", " + elevation_in_words(place.elevation) + ", " +
         number(place.distance, 2) + " m";
}

std::string aperture_in_words(double aperture_f) {
  const long thirds = std::lround(6 * std::log2(std::max(aperture_f, 1e-3)));
  if (thirds < 0 || thirds >= static_cast<long>(kApertures.size()))
    return "f/" + significant(aperture_f, 2);
  return "f/" + number(kApertures[static_cast<std::size_t>(thirds)], 1);
}

std::string shutter_in_words(double shutter_s) {
  // Slower than a third of a second is shown in seconds, as cameras do.
  if (shutter_s > 0.34) return significant(shutter_s, 2) + " s";
  return "1/" + significant(1 / shutter_s, 3) + " s";
}

std::string setting_in_words(const CameraSetting& s) {
  return aperture_in_words(s.aperture_f) + " at " + shutter_in_words(s.shutter_s) + ", ISO " +
         significant(s.iso, 3);
}

std::optional<Lux> meter_reading(const std::string& text) {
  std::vector<std::string> words = words_of(text);
  if (const auto light = illuminance(words)) return light;
  std::optional<double> aperture, exposed, iso;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string_view word = words[i];
    if (word == "at" || word == "s") continue;
    std::optional<double>* into = &exposed;
    std::optional<double> value;
    if (word == "iso" && i + 1 < words.size()) {
      into = &iso;
      value = whole_number(words[++i]);
    } else if (starts_with(word, "iso")) {
      into = &iso;
      value = whole_number(word.substr(3));
    } else if (starts_with(word, "f")) {
      into = &aperture;
      word.remove_prefix(starts_with(word, "f/") ? 2 : 1);
      value = whole_number(word);
    } else {
      value = shutter(word);
    }
    if (!value || *into) return std::nullopt;
    *into = value;
  }
  if (!aperture || !exposed || !iso) return std::nullopt;
  return lux_for({*aperture, *exposed, *iso});
}

}  // namespace chiaro::core
