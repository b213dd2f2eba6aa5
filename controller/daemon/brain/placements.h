// SPDX-License-Identifier: Apache-2.0
// Where the stands really are, how knobs, gels and flashes are set, what a meter read, and which
// fixtures are locked: what people have done in the studio since its file was written. Kept in the
// store.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controller/core/dof.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

class Placements {
 public:
  /// As the file says, overlaid with what the store remembers for this studio (`json`, "" = none).
  /// A stand whose place in the file has changed since is where the file says.
  Placements(const studio::Studio& studio, const std::string& json);
  std::string to_json(const studio::Studio& studio) const;

  /// The place of a stand and whatever else a hand has set.
  const core::FixtureState& at(std::size_t fixture) const { return placed_[fixture]; }
  void move(std::size_t fixture, const core::FixtureState& to) { placed_[fixture].overlay(to); }
  /// Output as a meter found it, bare optic or fitted as it is; nothing: the data sheet's.
  const std::optional<core::Candela>& measured(std::size_t fixture) const {
    return measured_[fixture];
  }
  void measure(std::size_t fixture, std::optional<core::Candela> output) {
    measured_[fixture] = output;
  }
  bool locked(std::size_t fixture) const { return locked_[fixture]; }
  void lock(std::size_t fixture, bool on) { locked_[fixture] = on; }
  /// The studio as it stands.
  studio::Studio placed_studio(const studio::Studio& studio) const;

 private:
  std::vector<core::FixtureState> placed_;
  std::vector<bool> locked_;
  std::vector<std::optional<core::Candela>> measured_;
};

/// What a person sets on the lamp itself as it should be: within 5 %, 75 K.
bool is_set(const studio::HandBinding& binding, const core::FixtureState& wanted,
            const core::FixtureState& placed);
/// Near enough that nobody need move the stand: 1 degree, 3 cm.
bool stands_there(const core::FixtureState& wanted, const core::FixtureState& placed);

}  // namespace chiaro::daemon
