// SPDX-License-Identifier: Apache-2.0
// What an operator may do, as values. Made from a request by pure functions that know the state:
// when a gesture exists, its names are known, its numbers are within the limits. The brain carries
// it out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "controller/panel/http.h"
#include "controller/panel/state.h"

namespace chiaro::panel {

/// Exactly one of mood, picture, ideal.
struct StartDesign {
  std::string mood;
  std::string picture;  ///< bytes of an uploaded reference picture
  std::string title;    ///< for people
  bool ideal = false;
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
/// A stand has been moved; an empty state means "exactly as wanted".
struct Placed {
  std::string fixture;
  core::FixtureState at;  ///< placement, inside units
};
struct Reload {};
struct MotionStop {
  bool on = true;
};
struct Blackout {
  bool on = true;
};
struct AddMood {
  std::string name, title, picture;
};
struct RemoveMood {
  std::string name;
};
using Gesture =
    std::variant<StartDesign, CancelDesign, SaveLook, ApplyLook, DeleteLook, Undo, SetFixture,
                 SetMaster, Placed, Reload, MotionStop, Blackout, AddMood, RemoveMood>;

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
