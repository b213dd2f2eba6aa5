// SPDX-License-Identifier: Apache-2.0
// A small cue stack: looks in an order, each with its time, and a follow where the next goes by
// itself. It lives in the hand, so a show goes on when the brain does not.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controller/ports/clock.h"
#include "controller/rig/wanted.h"

namespace chiaro::rig {

struct Cue {
  double number = 1;  ///< the trade's: 2.5 comes between 2 and 3
  std::string name;
  std::optional<double> follow_s;  ///< from its go to the next one's
  SourceState state;               ///< its levels, and fade_s: the time of its crossfade
  /// The same, but lamps that are dark here and lit in the next cue are already set to that one's
  /// colour, zoom and place: for lamps that move in black.
  SourceState ahead;
};

/// Ascending by number. Made off the loop.
struct CueList {
  std::uint64_t studio = 0;  ///< the fingerprint of the one whose lamps its indices mean
  std::vector<Cue> cues;
  /// Puts a cue in its place, or in the place of the one with its number.
  void put(Cue cue);
  bool remove(double number);
  /// Works out every `ahead`.
  void look_ahead();
};

/// The loop's; real-time. What it returns is to be played and stays valid until another list is
/// taken.
class CueStack {
 public:
  /// Takes `list` and leaves the old one in its place; the cue that plays keeps its place by number
  /// and its follow.
  void take(std::unique_ptr<CueList>& list);
  /// The next, the one before, the one with that number; null when there is none.
  const Cue* go(ports::TimePoint now);
  const Cue* back(ports::TimePoint now);
  const Cue* to(double number, ports::TimePoint now);
  /// The one whose time has come.
  const Cue* due(ports::TimePoint now);
  /// Nothing of it is on stage any more. The next go begins with the first.
  void off() { playing_ = -1; }
  /// After a power cut: that cue stands on stage and is not played again.
  const Cue* stand_at(double number);
  Sent::CueState state(ports::TimePoint now) const;

 private:
  const Cue* play(std::ptrdiff_t which, ports::TimePoint now);
  std::ptrdiff_t find(double number) const;

  std::unique_ptr<CueList> list_ = std::make_unique<CueList>();
  std::ptrdiff_t playing_ = -1;
  ports::TimePoint went_;
  bool follows_ = false;
};

}  // namespace chiaro::rig
