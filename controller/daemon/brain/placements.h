// SPDX-License-Identifier: Apache-2.0
// Where the stands really are, and which fixtures are locked: what people have done in the studio
// since its file was written. Kept in the store.
#pragma once

#include <set>
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

  const core::FixtureState& at(std::size_t fixture) const { return placed_[fixture]; }
  void move(std::size_t fixture, const core::FixtureState& to) { placed_[fixture].overlay(to); }
  bool locked(std::size_t fixture) const { return locked_[fixture]; }
  void lock(std::size_t fixture, bool on) { locked_[fixture] = on; }
  /// The studio as it stands.
  studio::Studio placed_studio(const studio::Studio& studio) const;

 private:
  std::vector<core::FixtureState> placed_;
  std::vector<bool> locked_;
};

/// Near enough that nobody need move the stand: 1 degree, 3 cm.
bool stands_there(const core::FixtureState& wanted, const core::FixtureState& placed);

}  // namespace chiaro::daemon
