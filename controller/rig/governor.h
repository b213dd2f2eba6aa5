// SPDX-License-Identifier: Apache-2.0
// The last word on every level before it is encoded. Merges what the sources want, runs the fades,
// and applies masters, limits, caution and blackout, in this order:
//
//   merge > fade > flash guard > masters > caution (fade to safe) > limits (most, slew) > blackout
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
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "controller/core/dof.h"
#include "controller/ports/clock.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::rig {

/// Levels that have passed every limit. Only `Governor` can make one and only these can be
/// encoded (controller/patch), so no limit can be walked round.
class AllowedLevels {
 public:
  /// By fixture index. Uncontrolled fixtures have no value at all.
  std::span<const core::FixtureState> fixtures() const { return fixtures_; }

 private:
  friend class Governor;
  explicit AllowedLevels(std::size_t fixtures) : fixtures_(fixtures) {}
  std::vector<core::FixtureState> fixtures_;
};

/// What survives a power cut: levels before masters and blackout, so that both can be released.
struct Held {
  std::vector<core::FixtureState> fixtures;  ///< by fixture index; empty states: not known
  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  bool blackout = false;
};

/// A brain is silent when its newest word is older than this.
inline constexpr ports::Duration kSilence = std::chrono::seconds(1);

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
  /// numbers count as absent. A word for another studio is refused but for its blackout wish.
  void take(const Wanted& wanted, ports::TimePoint now);
  /// The brain's box cannot be read (another fingerprint, layout or size): hold until a word is
  /// taken again.
  void refuse();
  /// The hand's own blackout (socket, key): latched until released by anyone.
  void set_blackout(bool on);
  bool blackout() const;

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
