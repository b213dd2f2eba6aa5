// SPDX-License-Identifier: Apache-2.0
// What an operator may do, as values. Made from a request by pure functions that know the state:
// when a gesture exists, its names are known, its numbers are within the limits. The brain carries
// it out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/panel/http.h"
#include "controller/panel/state.h"

namespace chiaro::panel {

/// How a person bends what the reference asks for, in stops; each may be negative.
struct Nudges {
  double brighter = 0, softer = 0, warmer = 0, contrast = 0;
  friend bool operator==(const Nudges&, const Nudges&) = default;
};

/// Exactly one of mood, picture, ideal, flat.
struct StartDesign {
  std::string mood;
  std::string picture;  ///< bytes of an uploaded reference picture
  std::string title;    ///< for people
  bool ideal = false;
  bool flat = false;  ///< work light: even from the front, what a sitter looks like before a mood
  Nudges nudges;
  bool wavelet = true;  ///< goal "wavelet", else "perceptual"
  std::uint64_t seed = 1;
  std::uint64_t trials = 0;  ///< 0 = the engine's default
  std::optional<double> budget_s;
  std::vector<std::string> lock;
  bool move_stands = true;
  std::optional<double> apply_fade_s;  ///< given: applied with this fade once found
};
struct CancelDesign {
  std::uint64_t job = 0;
};
/// Keeps what is live now under a name, or takes a look.json.
struct SaveLook {
  std::string name;
  std::string look_json;  ///< "" = what is live now
};
struct RenameLook {
  std::int64_t id = 0;
  std::string name;
};
struct ApplyLook {
  std::int64_t id = 0;
  double fade_s = 1.5;
};
struct DeleteLook {
  std::int64_t id = 0;
};
/// Back to the look that was live before.
struct Undo {
  double fade_s = 1.5;
};
/// A little more of something than the live look has; on top of earlier nudges.
struct Nudge {
  Nudges by;
  double fade_s = 0.5;
};
/// Even light from the front, to work by and to begin from.
struct WorkLight {
  double fade_s = 1.5;
};
struct SetFixture {
  std::string fixture;
  core::FixtureState set;          ///< faders now held by hand, inside units
  std::vector<core::Dof> release;  ///< faders given back to the look
  std::optional<bool> lock;
};
struct SetMaster {
  std::size_t master = 0;  ///< index into kMasterNames
  double level = 1;
};
/// A person has moved a stand, turned a knob, fitted a gel or set a flash; an empty state means
/// "exactly as wanted".
struct Placed {
  std::string fixture;
  core::FixtureState at;  ///< of what a hand sets, inside units
};
/// What a light meter read of this lamp alone; nothing: back to the data sheet.
struct Measured {
  std::string fixture;
  std::optional<double> lux;
  std::optional<double> distance_m;  ///< from the lamp; where the sitter is when absent
  std::optional<double> intensity;   ///< at which it was read; what is being sent when absent
};
/// Where a tracker sees the subject now, from where the studio file has it; nothing: it is no
/// longer tracked, and the look is as it was.
struct TrackSubject {
  std::optional<core::Vec3> moved;  ///< metres, in the studio's axes
  double turned = 0;                ///< radians about the upright, to its left
};
struct Reload {};
struct MotionStop {
  bool on = true;
};
struct Blackout {
  bool on = true;
};
/// Slots of a lamp without a profile, raised for as long as the word is repeated; none: released.
struct TrySlots {
  std::uint16_t universe = 1;
  std::vector<std::pair<std::uint16_t, std::uint8_t>> levels;  ///< slot 1..512, raw level
};
/// What a person saw of each slot, from the first on: a profile and a patch line come of it.
struct LearnLamp {
  std::string name, role = "key", maker = "Own", model;
  std::uint16_t universe = 1, address = 1;
  struct Slot {
    std::string sees;          ///< one of kSeen
    std::uint8_t level = 255;  ///< for "keep": what is sent for ever
  };
  std::vector<Slot> slots;
  double output_cd = 5000;
  core::Range cct{3200, 5600};                  ///< equal ends: one colour
  std::string place = "45 left, 35 up, 1.8 m";  ///< on a track: one end of it
  std::string held = "stand";                   ///< one of kHeldBy
  std::uint16_t motor_slot = 0;                 ///< counted from the lamp's first; 0 = the next
  int motor_bits = 16;
  bool over = false;                               ///< an arc over the sitter, else round
  double travel_deg = 60;                          ///< of an arc, each way
  std::string far_end = "45 right, 35 up, 1.8 m";  ///< of a track
  double along = 0.5;                              ///< 0..1 of a track
  bool add = false;  ///< write profile and patch line, and read the studio again
};
struct AddMood {
  std::string name, title, picture;
  bool replace = true;  ///< an own picture of that name; else another name is found
};
struct RemoveMood {
  std::string name;
};
using Gesture =
    std::variant<StartDesign, CancelDesign, Nudge, WorkLight, SaveLook, RenameLook, ApplyLook,
                 DeleteLook, Undo, SetFixture, SetMaster, Placed, Measured, TrackSubject, Reload,
                 MotionStop, Blackout, TrySlots, LearnLamp, AddMood, RemoveMood>;

/// What a person may have seen a slot do.
inline constexpr const char* kSeen[] = {"nothing", "dimmer",     "fine",  "red",  "green", "blue",
                                        "white",   "warm_white", "amber", "lime", "cyan",  "cct",
                                        "tint",    "zoom",       "pan",   "tilt", "keep"};

/// What may hold a lamp: an arc and a track have a motor.
inline constexpr const char* kHeldBy[] = {"stand", "hung", "arc", "track"};

/// Every address that changes something, as routes.def lists them.
struct Address {
  const char *method, *path, *what, *example;
};
std::span<const Address> addresses();

/// The gesture that this POST, PUT or DELETE under /api/v1 means, or why it means none: 404 unknown
/// route or name (with the nearest), 405 wrong method, 400 malformed, 422 well-formed but not
/// possible. `words` is the path after /api/v1, split at slashes.
std::variant<Gesture, Refusal> gesture_of(const Request& request,
                                          const std::vector<std::string>& words,
                                          const State& state);

/// 404 "no mood is called 'rembrant'", with the nearest known name as remedy.
Refusal unknown_name(const std::string& kind, const std::string& name,
                     const std::vector<std::string>& known);
std::vector<std::string> mood_names(const State& state);
std::vector<std::string> fixture_names(const State& state);
std::vector<std::string> camera_names(const State& state);

}  // namespace chiaro::panel
