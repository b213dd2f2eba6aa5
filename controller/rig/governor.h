// SPDX-License-Identifier: Apache-2.0
// The last word on every level before it is encoded. Merges what the sources want, runs the fades,
// and applies marks, masters, limits, caution and blackout, in this order:
//
//   merge > fade > flash guard > move in black, motion > solo, flash > masters > highlight
//     > caution (fade to safe) > power of the circuit > limits (most, slew) > park > blackout
//
// So nothing a person marks walks round a limit, a parked lamp obeys no master but goes dark in a
// blackout, and whatever ends a mark shows the level below, which has gone on meanwhile.
//
// Fades of light run evenly in lightness (CIE L*), not in linear light: half-way through a fade to
// black a lamp looks half as bright, which is what an operator expects of "3 s"; evenly in linear
// light it would hang near full and then drop. CCT fades evenly in mired for the same reason.
// Everything else fades evenly in its own unit. Ends are exact.
//
// It has no clock, no thread and no file: time is an argument, so a test lives through an hour in
// a microsecond.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "controller/core/dof.h"
#include "controller/ports/clock.h"
#include "controller/rig/caution.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

/// Levels that have passed every limit. Only `Governor` can make one and only these can be
/// encoded (controller/patch), so no limit can be walked round.
class AllowedLevels {
 public:
  /// By fixture index. Uncontrolled fixtures have no value at all.
  std::span<const core::FixtureState> fixtures() const { return fixtures_; }
  /// The fixtures whose values may differ from those of the step before, ascending.
  std::span<const std::uint32_t> changed() const { return changed_; }

 private:
  friend class Governor;
  explicit AllowedLevels(std::size_t fixtures) : fixtures_(fixtures) { changed_.reserve(fixtures); }
  std::vector<core::FixtureState> fixtures_;
  std::vector<std::uint32_t> changed_;
};

/// What survives a power cut: levels before masters and blackout, so that both can be released.
struct Held {
  std::vector<core::FixtureState> fixtures;  ///< by fixture index; empty states: not known
  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  bool blackout = false;
  bool motion_stop = false;
  std::vector<Marks> marks, own_marks;  ///< by fixture index: all, and the hand's own
  std::vector<core::FixtureState> own;  ///< by fixture index: faders at the hand
  /// Wishes of the brain's that were taken before: hearing of them again starts no fade, moves no
  /// master and releases no latch that has been thrown at the hand since.
  std::array<std::uint64_t, kSources> fade_id{};
  std::array<std::uint64_t, kMasters> master_id{};
  std::uint64_t blackout_id = 0, stop_id = 0, arm_id = 0;
  std::optional<double> cue;  ///< that was on stage: the look of before the cut stays below it
  friend bool operator==(const Held&, const Held&) = default;
};

/// How long a flash lasts that was asked for at the hand and not asked for again.
inline constexpr ports::Duration kFlashLease = std::chrono::seconds(2);
/// How long a lamp that is let go at the hand takes to go back, seconds.
inline constexpr double kReleaseFade = 0.5;

/// Everything but construction is real-time: no allocation, lock, log or throw. One thread.
class Governor {
 public:
  /// `held`: what was sent before a power cut; none = come up dark or as the studio file says
  /// (Safety::PowerUp). Fixtures without a held value start at their initial level.
  Governor(const studio::Studio& studio, ports::TimePoint now, const Held* held = nullptr);
  ~Governor();
  Governor(Governor&&) noexcept;
  Governor& operator=(Governor&&) noexcept;

  /// The brain's newest word. Values outside a DOF's range are clamped, values that are not
  /// numbers count as absent. A word for another studio is refused but for its blackout and motion
  /// stop wishes.
  void take(const Wanted& wanted, ports::TimePoint now);
  /// The brain's box cannot be read (another fingerprint, layout or size): hold until a word is
  /// taken again.
  void refuse();
  /// The hand's own blackout (socket, key): latched until released by anyone.
  void set_blackout(bool on);
  bool blackout() const;
  /// The hand's own motion stop and arming; latched like the blackout.
  void stop_motion(bool on);
  void arm_motion(bool on);
  bool motion_stopped() const;
  bool motion_armed() const;
  /// A fader at the hand itself: at once, and above everything but limits, caution and blackout,
  /// until a newer word of the brain's (see `Source`) or `release`. Clamped to the DOF's range; a
  /// DOF that the lamp does not have, and what is no number, is passed over.
  void set_level(std::size_t fixture, core::Dof dof, double value, ports::TimePoint now);
  /// Gives the lamp back to whoever else has an opinion, in a fade of `kReleaseFade`.
  void release(std::size_t fixture, ports::TimePoint now);
  /// The newest of the hand's and the brain's wishes stands. 0..1.
  void set_master(Master master, double level);
  /// Blind at the hand: what the brain says is prepared, not sent; ended, it fades in by its ids.
  void set_blind(bool on);
  /// Marks a lamp at the hand itself, or takes that mark away (the brain's own marks stay).
  void mark(std::size_t fixture, Mark mark, bool on, ports::TimePoint now);
  /// Puts a cue on stage over its own fade time, or, with no fixtures, takes it off. A new look
  /// takes it off too. `ahead`: the same for lamps that move in black (cue_stack.h).
  void play(const SourceState& cue, const SourceState& ahead, ports::TimePoint now);
  bool cue_plays() const;
  /// After a power cut: that cue is what the held levels came from. Starts no fade.
  void stand_on(const SourceState& cue);

  /// The levels for a frame that leaves at `now`. Precondition: now does not go back.
  const AllowedLevels& step(ports::TimePoint now);

  Caution caution() const;
  /// Fills everything of the report that is the governor's. Precondition: `into` was made by
  /// `empty_report`.
  void report(Sent& into) const;
  Sent empty_report() const;

  /// Goes on where `before` is, mid-fade if need be: entry i of `from` is the index that this
  /// governor's fixture i had there, -1 for a new one.
  void carry_on(const Governor& before, std::span<const std::ptrdiff_t> from);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chiaro::rig
