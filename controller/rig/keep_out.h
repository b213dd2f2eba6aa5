// SPDX-License-Identifier: Apache-2.0
// Where people are: no motor may carry a lamp's body there. Made off the loop; asking is real-time.
#pragma once

#include <vector>

#include "controller/core/geometry.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

/// A lamp comes no nearer to a sitter's axis than this, whatever the studio file says.
inline constexpr double kPersonalSpace = 0.6;  // metres

class KeepOut {
 public:
  explicit KeepOut(const studio::Studio& studio);
  /// Whether fixture i's lamp may go from one state to the next: not deeper into anybody's space
  /// than it is. A lamp that is inside may leave.
  bool may_go(std::size_t i, const core::FixtureState& from, const core::FixtureState& to) const;

 private:
  /// Everything nearer to the upright line from `foot` to `head` than `radius`.
  struct Space {
    core::Vec3 foot, head;
    double radius;
  };
  /// A mount that carries its lamp along a circle or a line; others turn on the spot.
  struct Rail {
    bool carries = false, is_arc = false;
    core::Vec3 origin, along, up;  ///< arc: centre and its two radii; track: start and whole way
    double body = 0, at = 0;
  };
  static Rail rail_of(const studio::Fixture& fixture, const core::AimFrame& aim);
  static core::Vec3 place(const Rail& rail, const core::FixtureState& state);
  std::vector<Space> spaces_;
  std::vector<Rail> rails_;  ///< by fixture
};

}  // namespace chiaro::rig
