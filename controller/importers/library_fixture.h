// SPDX-License-Identifier: Apache-2.0
// A fixture as libraries describe them, whatever the library: channels with a meaning, and the few
// physical facts. Each importer fills this in; one function makes a profile of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controller/core/colour.h"
#include "controller/core/result.h"
#include "controller/studio/profile.h"

namespace chiaro::importers {

/// What a channel is for, as far as it concerns light, colour and aim.
enum class Meaning {
  unknown,    ///< held where it does nothing
  master,     ///< dims the whole lamp
  intensity,  ///< dims the lamp, or one cell of it
  red,
  green,
  blue,
  white,
  warm_white,
  amber,
  lime,
  cyan,       ///< an emitter
  uv,         ///< held dark, unless it is the only light
  cut_red,    ///< a cyan filter: more of it takes red away
  cut_green,  ///< magenta
  cut_blue,   ///< yellow
  cct,        ///< segments in kelvin
  tint,       ///< segments in Duv/1000
  crossfade,  ///< from a white mix to a colour mix
  pan,        ///< segments in radians where the library knows them
  tilt,
  zoom,
  shutter,  ///< held at open
  pwm,      ///< segments in hertz
};

struct LibraryChannel {
  std::string name;
  Meaning meaning = Meaning::unknown;
  std::vector<int> slots;                 ///< 0-based, most significant first, at most 3
  std::vector<studio::Segment> segments;  ///< empty = the whole channel, 0 to the most
  double held = 0;                        ///< raw fraction that does nothing, or is open
  std::optional<double> closed;           ///< raw fraction at which no light comes out …
  std::optional<double> lit;              ///< … and at which it does: at worst a switch
  bool backwards = false;                 ///< the law falls where segments are not known
};

struct LibraryMode {
  std::string name;
  int footprint = 0;
  std::vector<LibraryChannel> channels;
};

struct LibraryFixture {
  std::string maker, model;
  std::string kind;  ///< "Moving Head", "Smoke", …, as the library says
  std::vector<LibraryMode> modes;
  std::optional<double> candela, lumens, watts, cct;
  std::optional<core::Range> beam;         ///< radians, full; a zoom's ends
  std::optional<double> field;             ///< radians, full
  double pan_turn = 0, tilt_turn = 0;      ///< radians from end to end; 0 = not known
  double widest = 0;                       ///< metres; 0 = not known
  std::optional<studio::Optic> optic;      ///< where the library knows the shape
  std::vector<studio::Primary> primaries;  ///< where the library knows their colours
  bool shares_known = false;               ///< of `primaries`
  std::vector<std::string> assumed;        ///< the file has a number, but it is a format's default
};

struct Imported {
  studio::Profile profile;
  std::vector<std::string> left_out;  ///< one sentence each: what was not taken, and why
};

/// The profile of it, named "maker/model" in lower case. Refused with a reason when no mode gives
/// light that Chiaro can set. What nobody knows is assumed and listed in `profile.assumed`.
core::Result<Imported> profile_of(const LibraryFixture& fixture, const std::string& file);

/// "Generic LED/PAR 64" as a part of a profile's name: "generic-led-par-64".
std::string slug(const std::string& words);

/// The profile's file, in the form that config/fixtures/README.md tells; `origin` goes into a
/// comment. Reading it gives the profile back.
std::string profile_yaml(const studio::Profile& profile, const std::string& origin);

}  // namespace chiaro::importers
