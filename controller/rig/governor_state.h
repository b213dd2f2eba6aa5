// SPDX-License-Identifier: Apache-2.0
// The governor's inside, shared by its sources: what it hears (governor.cpp), how a frame follows
// from it (governor_step.cpp), what it reports and hands on (governor_report.cpp).
#pragma once

#include <vector>

#include "controller/rig/governor.h"
#include "controller/rig/keep_out.h"
#include "controller/rig/lamp.h"
#include "controller/rig/motion.h"
#include "controller/rig/power.h"
#include "controller/rig/sources.h"

namespace chiaro::rig {

/// How dark is dark, for a lamp that moves in black.
inline constexpr double kDark = 0.001;
/// A lamp is not kept dark for ever by an axis that does not arrive.
inline constexpr ports::Duration kMostWait = std::chrono::seconds(10);

struct Governor::State {
  State(const studio::Studio& studio, ports::TimePoint now);

  std::uint64_t fingerprint;
  std::vector<Lamp> lamps;
  Sources sources;
  Watch watch;
  Motion motion;
  PowerBudget power;
  KeepOut keep_out;
  AllowedLevels levels;

  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  /// The brain's newest wishes; no numbers until it has spoken to this governor.
  std::array<double, kMasters> brain_masters;
  std::array<std::uint64_t, kMasters> master_id{};
  std::vector<std::uint64_t> release_id;  ///< by lamp
  bool blackout = false, blind = false, own_blind = false, stepped = false;
  bool recalled = false;        ///< masters come from before a power cut
  bool heard_releases = false;  ///< what the brain said before this governor was made is done
  std::uint64_t blackout_id = 0, stop_id = 0, arm_id = 0;
  Caution caution = Caution::hold;
  ports::TimePoint last_step;
  double used_safe = 0;    ///< safe_progress of the last step
  bool brain_was = false;  ///< spoke, at the last step
  bool blackout_was = false, could_move = false;
  ports::TimePoint flash_until;

  // By lamp.
  std::vector<Marks> brains, own, marks;  ///< marks: both, as of the last change
  bool any_solo = false;
  std::vector<double> asked;        ///< intensity before power, limits and blackout
  std::vector<double> draws;        ///< intensity as its circuit will feel it
  std::vector<std::uint8_t> bound;  ///< that, whatever the circuit's factor
  std::vector<double> slewed;       ///< intensity after slew, before park and blackout
  std::vector<core::FixtureState> parked;
  std::vector<std::uint8_t> is_parked, woken;
  std::vector<ports::TimePoint> waits_since;  ///< in the dark for its axes; zero: it does not
  std::vector<Limited> limited;
  std::vector<std::uint8_t> axes_waiting;

  void add(const Lamp& lamp, const core::FixtureState* held);
  void wake_all() { std::fill(woken.begin(), woken.end(), std::uint8_t{1}); }
  void settle_marks();
  void recall(const Held& held, bool dark);
  void recall_marks(const Held& held);
  void hear_latches(const Wanted& wanted);
  void hear_masters(const Wanted& wanted);
  void hear_releases(const Wanted& wanted, ports::TimePoint now);
  void set_master(std::size_t master, double level);

  // A frame, lamp by lamp (governor_step.cpp).
  bool may_move() const { return motion.armed() && !motion.stopped() && !blackout; }
  void look_around(ports::TimePoint now, double elapsed);
  bool follow(std::size_t i, ports::TimePoint now, double elapsed);
  bool follow_axis(std::size_t i, std::size_t d, double wanted, double elapsed);
  bool follow_light(std::size_t i, std::size_t d, double wanted, ports::TimePoint now);
  bool wait_in_the_dark(std::size_t i, bool there, ports::TimePoint now);
  double marked_and_mastered(std::size_t i) const;
  double master(const Lamp& lamp) const;
  void weigh(std::size_t i);
  bool finish(std::size_t i, double elapsed);
  void open_white(std::size_t i);
  bool limit(std::size_t i, double wanted, double elapsed);
};

}  // namespace chiaro::rig
