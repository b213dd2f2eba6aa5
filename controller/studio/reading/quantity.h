// SPDX-License-Identifier: Apache-2.0
// Numbers with their unit in the value: `26 deg`, `40 Hz`, `1.3 stops`. Values come out in inside
// units (metres, radians, seconds, hertz, kelvin, lux, candela, stops, watts).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace chiaro::studio::reading {

enum class Measure {
  length,
  angle,
  frequency,
  duration,
  temperature,
  illuminance,
  intensity,
  stops,
  power,
};

/// "a length", "an example": for messages.
struct MeasureWords {
  std::string_view noun, example;
};
MeasureWords words(Measure measure);
/// The value as a person writes it: "26 deg", "1.2 m".
std::string written(Measure measure, double inside);

enum class Misread { not_a_number, no_unit, unknown_unit, wrong_unit };
struct Parsed {
  std::optional<double> value;  ///< finite; absent: see why
  Misread why = Misread::not_a_number;
  std::string unit;  ///< as written
};
Parsed parse_quantity(std::string_view text, Measure measure);
/// A plain finite number, the whole text.
std::optional<double> parse_number(std::string_view text);

}  // namespace chiaro::studio::reading
