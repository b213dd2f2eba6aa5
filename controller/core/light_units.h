// SPDX-License-Identifier: Apache-2.0
// Light in the units that photographers, gaffers and meters use, and in their words. Pure
// functions, thread-safe; text is UTF-8 for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/core/units.h"

namespace chiaro::core {

// ---- numbers -----------------------------------------------------------------------------------

/// One lumen a square foot; the foot is exactly 0.3048 m.
inline constexpr double kMetresPerFoot = 0.3048;
double foot_candles(Lux light);
Lux lux_of_foot_candles(double foot_candles);
double feet(double metres);

/// The incident-light constant of ISO 2720 for a flat receptor, as studio::exposure_gain has it.
inline constexpr double kIncidentConstant = 250;

struct CameraSetting {
  double aperture_f = 4, shutter_s = 1.0 / 50, iso = 100;
};
/// What a flat incident meter pointed at the lamp has in front of it when it shows this setting:
/// N^2 / t = E S / C. Preconditions: all positive.
Lux lux_for(const CameraSetting& setting);
/// The aperture it would show at that shutter and ISO; 0 for no light.
double aperture_for(Lux light, double shutter_s, double iso);
/// Exposure of a flash, lux seconds, when a flash meter shows this aperture at this ISO; the
/// shutter does not matter: N^2 = H S / C.
double lux_seconds_for(double aperture_f, double iso);

/// A lamp's output from a meter held facing it: I = E d^2. From nearer than about five times the
/// lamp's size the far-field answer is too low; see near_field. Preconditions: distance > 0.
Candela candela_from(Lux reading, double distance_m);
Candela candela_from(const CameraSetting& reading, double distance_m);
/// True where a meter stands too near to a lamp of that size for I = E d^2 to hold within 4 %.
bool near_field(double distance_m, double lamp_size_m);

/// Stops below full of a level 0..1, >= 0; nothing for a dark lamp.
std::optional<double> stops_below_full(double level);

/// Flash powers 1/1 … 1/128 in thirds of a stop, brightest first: 22 of them.
std::vector<double> flash_powers();
/// The nearest of them in stops; nothing below 1/128 by more than a sixth of a stop.
std::optional<double> nearest_flash_power(double level);

// ---- words -------------------------------------------------------------------------------------

/// A number without needless zeros: 1.6, 2, 0.45.
std::string number(double value, int decimals);
/// "1⅓ stops", "⅔ stop", "2 stops"; rounded to thirds, sign dropped.
std::string stops_in_words(double stops);
/// "full", "35 %".
std::string level_in_words(double level);
/// "full", "35 % (1⅔ stops below full)", "dark".
std::string level_and_stops(double level);
/// "off", "full power", "1/4 power", "1/4 - ⅓ power"; below 1/128 "off".
std::string flash_power_in_words(double level);
/// "420 lx (39 fc)"; three significant figures.
std::string illuminance_in_words(Lux light);
/// "5600 K", "5600 K, +4 green", "3200 K, -3 green (magenta)"; tint is Duv in thousandths.
std::string white_in_words(Kelvin cct, double tint = 0);
/// "4:1 (2 stops)"; "1:1 (even)"; ratio is of light, brighter to darker whichever comes first.
/// Precondition: ratio > 0.
std::string ratio_in_words(double ratio);
/// "1.6 m (5 ft 3 in)".
std::string distance_in_words(double metres);
/// "47° camera left", "at the camera's azimuth", "straight behind"; radians.
std::string azimuth_in_words(double azimuth);
/// "38° up", "12° down"; radians.
std::string elevation_in_words(double elevation);
/// "47° camera left, 38° up, 1.6 m"
std::string place_in_words(const Spherical& place);
/// "f/4", "f/5.6": the marks on lenses in thirds of a stop.
std::string aperture_in_words(double aperture_f);
/// "1/50 s", "2 s".
std::string shutter_in_words(double shutter_s);
/// "f/4 at 1/50 s, ISO 100"
std::string setting_in_words(const CameraSetting& setting);

// ---- typed in ----------------------------------------------------------------------------------

/// A meter reading as a person types it: "420 lx", "39 fc", "f/5.6 1/50 ISO 100" (any order, "at"
/// and commas allowed). Nothing where it is not one.
std::optional<Lux> meter_reading(const std::string& text);

}  // namespace chiaro::core
