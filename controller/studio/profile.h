// SPDX-License-Identifier: Apache-2.0
// A fixture profile: what the maker's data sheet says of one lamp. Its channels are laws that
// turn a degree of freedom into DMX and back. Profiles are files in config/fixtures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controller/core/colour.h"
#include "controller/core/dof.h"
#include "controller/core/result.h"
#include "controller/core/units.h"

namespace chiaro::studio {

/// Where light leaves the lamp. Sizes in metres, angles are full angles in radians.
struct Optic {
  enum class Kind { point, spot, directional, rectangle, disk };
  Kind kind = Kind::point;
  double beam = core::radians(60);   ///< spot: full angle within which light is full
  double field = core::radians(80);  ///< spot: full angle beyond which there is none
  double width = 0, height = 0;      ///< rectangle
  double radius = 0;                 ///< disk
  enum class Attenuation { inverse_square, linear, none };
  Attenuation attenuation = Attenuation::inverse_square;
  friend bool operator==(const Optic&, const Optic&) = default;
};

/// One LED or lamp inside the fixture.
struct Primary {
  core::Dof dof = core::Dof::white;  ///< the drive it answers to (red, green, blue, white, …)
  core::Chromaticity chromaticity;
  double share = 1;  ///< of the fixture's full output when driven alone at 1
};

struct Emitter {
  /// mixed = RGB, RGBW, RGBWW, RGBACL: see primaries. blend = a bicolour white and a mix of
  /// primaries, each complete, with a channel that fades from the one to the other (DOF crossfade:
  /// 0 the white alone, 1 the colours alone).
  enum class Kind { dimmer, bicolour, mixed, blend };
  Kind kind = Kind::dimmer;
  core::Kelvin cct{5600};             ///< dimmer: its fixed colour
  core::Range cct_range{3200, 5600};  ///< bicolour, blend: kelvin
  core::Range tint_range{0, 0};       ///< bicolour, blend: Duv/1000
  std::vector<Primary> primaries;     ///< mixed, blend
  bool has_white_mix() const { return kind == Kind::bicolour || kind == Kind::blend; }
};

/// How a level of linear light becomes a number on the wire.
struct DimmerCurve {
  enum class Law { linear, square, gamma, s_curve, table };
  Law law = Law::linear;
  double gamma = 2.2;         ///< for Law::gamma: light = drive^gamma
  std::vector<double> table;  ///< for Law::table: light at evenly spaced drives 0..1, monotonic
  friend bool operator==(const DimmerCurve&, const DimmerCurve&) = default;
};

/// One piece of a channel's law: DMX from..to (in units of the channel's resolution as a fraction
/// 0..1 of full scale) means physical from..to of the channel's DOF.
struct Segment {
  enum class Law { continuous, neutral, no_effect };
  double dmx_from = 0, dmx_to = 1;
  double physical_from = 0, physical_to = 1;
  Law law = Law::continuous;
};

/// What a channel is to its degree of freedom, or for what it is held.
enum class ChannelUse {
  controls,  ///< is its value: the DOF's own channel
  trims,     ///< is *added* to the value of the channel that controls the DOF (coarse + trim: the
             ///< ranges overlap, so this is no low byte)
  repeats,   ///< carries the same value once more: the second, third … cell of the lamp
  constant,  ///< no DOF: held for ever (a programme channel at "off")
  open,      ///< no DOF: a shutter or strobe, held at "open"
  pwm,       ///< no DOF: the frequency at which the LEDs are switched, held at `pwm_hz`
};

struct Channel {
  std::string name;
  std::optional<core::Dof> dof;   ///< none: constant (strobe at "open", a mode channel)
  int bytes = 1;                  ///< 1, 2 or 3, most significant first
  int offset = 0;                 ///< first slot, from the fixture's address
  double constant = 0;            ///< when no dof: raw fraction 0..1 sent for ever
  std::vector<Segment> segments;  ///< monotonic; one whole-range segment when the file gives none
  ChannelUse use = ChannelUse::controls;  ///< meaningless without dof unless open or pwm
  std::vector<int> finer;                 ///< slots of the lower bytes where they do not follow
  double pwm_hz = 0;                      ///< pwm: as held
  std::optional<double> rest;  ///< raw fraction sent while the DOF has no value; 0 when absent
  /// Slot of byte 0 (most significant), 1 or 2, from the fixture's address.
  int slot(int byte) const {
    return byte == 0 || finer.empty() ? offset + byte : finer[static_cast<std::size_t>(byte - 1)];
  }
};

struct Mode {
  std::string name;
  int footprint = 1;  ///< slots
  std::vector<Channel> channels;
};

/// What the lamp itself does when DMX stops coming.
enum class OnLoss { unknown, hold, dark, full };

struct Profile {
  std::string name;  ///< "generic/dimmer"
  std::string maker, model;
  core::Candela output{1000};  ///< on axis at full, all emitters as the profile's white
  Optic optic;
  Emitter emitter;
  DimmerCurve curve;
  core::Range zoom{0, 0};
  core::Range pan{0, 0}, tilt{0, 0};  ///< a moving head's own angles, 0 in the middle
  double body_radius = 0.15;  ///< metres: the lamp's body as a sphere, for feasibility
  OnLoss on_loss = OnLoss::unknown;
  /// What the file does not know and had to assume: "output", "beam", "colours", "cct".
  std::vector<std::string> assumed;
  std::vector<Mode> modes;
};

/// The DMX fraction that means `value`, or the nearest that can be had; dead bands are met in
/// their middle; `value` itself without segments. Real-time.
double fraction_of(const std::vector<Segment>& segments, double value);
/// What `fraction` means; between two segments the nearer counts. Nothing where it has no effect.
/// Real-time.
std::optional<double> meaning_of(const std::vector<Segment>& segments, double fraction);

}  // namespace chiaro::studio
