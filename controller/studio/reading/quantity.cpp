// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/quantity.h"

#include <array>
#include <charconv>
#include <cmath>

#include "controller/core/units.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {
namespace {

struct UnitName {
  std::string_view name;
  Measure measure;
  double inside;  ///< one of it in inside units
};

/// The first of each measure is the one we write.
constexpr std::array kUnits{
    UnitName{"m", Measure::length, 1},
    UnitName{"cm", Measure::length, 0.01},
    UnitName{"mm", Measure::length, 0.001},
    UnitName{"ft", Measure::length, 0.3048},
    UnitName{"in", Measure::length, 0.0254},
    UnitName{"deg", Measure::angle, core::kPi / 180},
    UnitName{"°", Measure::angle, core::kPi / 180},
    UnitName{"rad", Measure::angle, 1},
    UnitName{"Hz", Measure::frequency, 1},
    UnitName{"s", Measure::duration, 1},
    UnitName{"ms", Measure::duration, 0.001},
    UnitName{"min", Measure::duration, 60},
    UnitName{"K", Measure::temperature, 1},
    UnitName{"lx", Measure::illuminance, 1},
    UnitName{"lux", Measure::illuminance, 1},
    UnitName{"fc", Measure::illuminance, 10.763910416709722},
    UnitName{"cd", Measure::intensity, 1},
    UnitName{"kcd", Measure::intensity, 1000},
    UnitName{"stops", Measure::stops, 1},
    UnitName{"stop", Measure::stops, 1},
    UnitName{"W", Measure::power, 1},
    UnitName{"kW", Measure::power, 1000},
};

/// Reads a number off the front; `rest` is what follows.
std::optional<double> leading_number(std::string_view text, std::string_view& rest) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || !std::isfinite(value)) return std::nullopt;
  rest = text.substr(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

MeasureWords words(Measure measure) {
  switch (measure) {
    case Measure::length:
      return {"a length", "0.6 m"};
    case Measure::angle:
      return {"an angle", "26 deg"};
    case Measure::frequency:
      return {"a rate", "40 Hz"};
    case Measure::duration:
      return {"a time", "1.5 s"};
    case Measure::temperature:
      return {"a colour temperature", "5600 K"};
    case Measure::illuminance:
      return {"an illuminance", "800 lx"};
    case Measure::intensity:
      return {"a luminous intensity", "12000 cd"};
    case Measure::power:
      return {"a power", "2300 W"};
    case Measure::stops:
      return {"a number of stops", "1.3 stops"};
  }
  return {};
}

std::string written(Measure measure, double inside) {
  for (const UnitName& unit : kUnits)
    if (unit.measure == measure) return digits(inside / unit.inside) + " " + std::string(unit.name);
  return digits(inside);
}

Parsed parse_quantity(std::string_view text, Measure measure) {
  std::string_view rest;
  auto value = leading_number(trimmed(text), rest);
  if (!value) return {};
  // Shutter times are written as fractions: 1/50 s.
  if (measure == Measure::duration && !rest.empty() && rest.front() == '/') {
    const auto below = leading_number(rest.substr(1), rest);
    if (!below || *below == 0) return {};
    value = *value / *below;
  }
  rest = trimmed(rest);
  if (rest.empty()) return {std::nullopt, Misread::no_unit, ""};
  for (const UnitName& unit : kUnits)
    if (unit.name == rest) {
      if (unit.measure != measure) return {std::nullopt, Misread::wrong_unit, std::string(rest)};
      return {*value * unit.inside, {}, std::string(rest)};
    }
  return {std::nullopt, Misread::unknown_unit, std::string(rest)};
}

std::optional<double> parse_number(std::string_view text) {
  std::string_view rest;
  const auto value = leading_number(trimmed(text), rest);
  return value && rest.empty() ? value : std::nullopt;
}

}  // namespace chiaro::studio::reading
