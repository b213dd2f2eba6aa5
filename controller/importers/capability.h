// SPDX-License-Identifier: Apache-2.0
// What the words of fixture libraries mean: "Strobe, slow to fast", "Dimmer 0 - 100 %", "2700K".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controller/core/units.h"
#include "controller/importers/library_fixture.h"

namespace chiaro::importers {

/// One range of a channel as a library words it; raw values of the channel's own resolution.
struct Capability {
  double from = 0, to = 255;
  std::string words;                  ///< lower case
  bool open = false, closed = false;  ///< where the library says so by more than words
};

bool mentions(std::string_view words, std::initializer_list<std::string_view> any);
/// The meaning of a channel by its name alone.
Meaning meaning_of_name(const std::string& lower_case_name);
/// "2700K to 6500 K": both ends in the order of the words.
std::optional<core::Range> kelvins_in(const std::string& words);

/// The law of a dimmer from its capabilities: the longest that dims; stretches that are dark or
/// full beside it become dead bands. Empty where the whole channel dims or nothing fits.
std::vector<studio::Segment> dimmer_law(const std::vector<Capability>& capabilities, double full);
/// Of a shutter: a raw fraction at which it stands open, and one at which it is closed. Without a
/// word about it, open is where the channel does nothing: at 0.
struct Shutter {
  double open = 0;
  std::optional<double> closed, lit;  ///< both or none: it can serve as a switch
};
Shutter shutter_law(const std::vector<Capability>& capabilities, double full);
/// Of any other channel: the raw fraction at which it does nothing.
double idle(const std::vector<Capability>& capabilities, double full);

}  // namespace chiaro::importers
