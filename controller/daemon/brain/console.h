// SPDX-License-Identifier: Apache-2.0
// The brain's word to the hand, kept as state: which levels the look asks for, which faders a
// person holds, the masters, the wish for darkness. Fade ids grow for ever, over restarts too,
// because they are taken from the clock that both processes share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

class Console {
 public:
  explicit Console(const studio::Studio& studio);

  /// Takes over what a hand that outlived the last brain is doing: nothing changes on the wire.
  void adopt(const rig::Wanted& hand);
  /// Carries everything over to another studio by fixture name (after a reload).
  void carry_to(const studio::Studio& before, const studio::Studio& after);

  /// Fades to a look's levels, colours and motorised placements; what a person moves stays out.
  /// Faders that were held give way in the same fade, so that a click on a mood shows that mood.
  void apply(const studio::Studio& studio, const studio::Rig& rig, double fade_s,
             ports::TimePoint now);
  /// What the look is to be from now on, in small steps while a subject is followed: faders that a
  /// person holds stay above it.
  void follow(const studio::Studio& studio, const studio::Rig& rig, double fade_s,
              ports::TimePoint now);
  /// When the last look that was applied has faded in.
  ports::TimePoint faded() const { return faded_; }
  /// A person's faders: at once, above the look.
  void hold(std::size_t fixture, const core::FixtureState& values, ports::TimePoint now);
  /// Gives faders back to the look, in a short fade.
  void release(std::size_t fixture, std::span<const core::Dof> dofs, ports::TimePoint now);
  void set_master(std::size_t master, double level, ports::TimePoint now);
  /// Raises slots that no lamp has (the hand sees to that), until then; none: lets them fall.
  void try_slots(std::span<const rig::TriedSlot> slots, ports::TimePoint until);
  /// The id to wait for in the hand's report.
  std::uint64_t blackout(bool on, ports::TimePoint now);
  std::uint64_t motion_stop(bool on, ports::TimePoint now);

  const core::FixtureState& held(std::size_t fixture) const;
  bool has_look() const;
  const rig::Wanted& wanted() const { return wanted_; }

 private:
  rig::SourceState& source(rig::Source which);
  void set_look(const studio::Studio& studio, const studio::Rig& rig);
  std::uint64_t next_id(ports::TimePoint now);

  std::size_t fixtures_;
  rig::Wanted wanted_;
  std::uint64_t newest_id_ = 0;
  ports::TimePoint faded_;
};

/// Fixtures' values that a person sets: placements of stands, knobs, gels.
bool set_by_hand(const studio::Fixture& fixture, core::Dof dof);

}  // namespace chiaro::daemon
