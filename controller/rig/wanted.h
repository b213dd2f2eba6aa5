// SPDX-License-Identifier: Apache-2.0
// What brain and hand tell each other, as values: state, never events. They travel through two
// one-way boxes in shared memory (controller/daemon/box.h), so a reader that missed ten posts has
// missed nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "controller/core/dof.h"
#include "controller/ports/clock.h"

namespace chiaro::rig {

/// Later entries win where they have a value: blackout (apart) > own > manual > cue > look >
/// automatic > default (the levels of the last power-down where they were kept, else the studio
/// file's). `cue` and `own` are the hand's; the brain leaves them empty.
///   cue: the hand's cue stack (cue_stack.h). The newest of cue and look is on stage, because a new
///     look ends the cue.
///   own: faders at the hand itself, of a control surface or `chiaro level`. The newest of own and
///     manual has the say, because a new manual value takes the lamp's own away; and a new look
///     takes all of them, as it takes the manual ones.
enum class Source : std::uint8_t { automatic, look, cue, manual, own };
inline constexpr std::size_t kSources = 5;

/// What a person may mark a lamp with, for as long as the mark stands. Bits of a `Marks`.
enum class Mark : std::uint8_t {
  highlight = 1,  ///< full and open white, above the masters: to find and to focus it
  flash = 2,      ///< full in its own colour, under the masters; falls when its brain falls silent
  solo = 4,       ///< while any lamp has it, those without are dark (house lights stay)
  park = 8,  ///< stays exactly as it was sent when it was parked, whatever is asked or mastered
  /// Goes to its next colour, zoom and place in the dark: on the way out after it is dark, on the
  /// way in before it is lit.
  move_in_black = 16
};
using Marks = std::uint8_t;
constexpr bool has(Marks marks, Mark mark) { return (marks & static_cast<Marks>(mark)) != 0; }
std::string_view name_of(Mark mark);

/// A switch that several may throw: a new id carries a new wish, the hand's own state may differ.
struct Latch {
  bool on = false;
  std::uint64_t id = 0;
};

/// Why a lamp is not sent what is wanted of it. Bits of a `Limited`.
enum class Limit : std::uint8_t {
  most = 1,     ///< its own limit, in the studio file
  slew = 2,     ///< on its way
  flash = 4,    ///< a program wanted it to flash more than three times a second
  power = 8,    ///< its circuit's budget
  motion = 16,  ///< an axis would move, but motion is stopped or not armed
  person = 32   ///< an axis would come too near a person
};
using Limited = std::uint8_t;
std::string_view name_of(Limit limit);

/// Ordered: later wins.
enum class Caution : std::uint8_t { normal, hold, fade_to_safe, blackout };
std::string_view name_of(Caution caution);

/// One source's word on every fixture. A repeated fade id does not restart the fade; each fade
/// starts from what the hand is sending when it first sees the id. A value that changes under an
/// old id is followed at once, or by the end of the fade that is still running. A source that lets
/// a DOF go fades it to the next source when it says so with a new id, else it jumps.
struct SourceState {
  std::vector<core::FixtureState> fixtures;  ///< by fixture index; absent DOFs: no opinion
  std::uint64_t fade_id = 0;
  double fade_s = 0;
};

enum class Master : std::uint8_t { grand, key, fill, back, background };
inline constexpr std::size_t kMasters = 5;
std::string_view name_of(Master master);

/// One slot that a person raises to find out what it does: a lamp without a profile.
struct TriedSlot {
  std::uint16_t universe = 0;  ///< 0 = none
  std::uint16_t slot = 0;      ///< 1..512
  std::uint8_t level = 0;
};
inline constexpr std::size_t kTriedSlots = 32;

/// Brain to hand.
struct Wanted {
  std::uint64_t studio_fingerprint = 0;
  std::int64_t posted_ns = 0;  ///< monotonic clock of the post: the brain's age
  std::array<SourceState, kSources> sources;
  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  /// A new id carries a new wish; a master may have been moved at the hand itself since.
  std::array<std::uint64_t, kMasters> master_id{};
  bool blackout = false;          ///< as the brain's API wants it; latched by blackout_id
  std::uint64_t blackout_id = 0;  ///< a new id carries a new wish; the hand's own latch may differ
  std::vector<Marks> marks;       ///< by fixture; added to what was marked at the hand itself
  /// By fixture: a new id lets the faders go that hold the lamp at the hand itself.
  std::vector<std::uint64_t> release_id;
  bool blind = false;  ///< sources are prepared, not sent; on release they fade in by their ids
  /// Freezes every axis with the light held; stopping also disarms, so that releasing the stop
  /// moves nothing yet.
  Latch motion_stop;
  Latch motion_armed;  ///< a person allows axes to move; off at every start, and refused in a stop
  std::array<TriedSlot, kTriedSlots> tried{};
  std::int64_t tried_until_ns = 0;  ///< monotonic clock: then they fall back to 0 by themselves
};

/// Hand to brain.
struct Sent {
  std::uint64_t studio_fingerprint = 0;
  std::int64_t sent_ns = 0;
  std::vector<core::FixtureState> fixtures;  ///< what the lamps are being told now
  std::vector<core::FixtureState> held;      ///< the same before masters, caution and blackout
  std::array<SourceState, kSources>
      sources;  ///< the sources as the hand holds them: a starting brain adopts them
  std::array<double, kMasters> masters{1, 1, 1, 1, 1};
  std::array<std::uint64_t, kMasters> master_id{};  ///< the newest wishes of the brain's taken
  std::array<std::uint64_t, kSources> fade_id{};    ///< in progress or last
  std::array<double, kSources> fade_progress{};     ///< 0..1
  Caution caution = Caution::normal;
  bool blackout = false;
  std::uint64_t blackout_id = 0;  ///< the newest wish the hand has taken
  bool refused = false;           ///< fingerprints differ: holding
  std::vector<Marks> marks;       ///< by fixture, whoever set them
  std::vector<Marks> own_marks;   ///< those set at the hand itself
  std::vector<Limited> limited;   ///< by fixture
  bool blind = false;
  Latch motion_stop, motion_armed;  ///< as they are; id: the newest wish of the brain's taken
  std::uint32_t axes_waiting = 0;   ///< axes that would move if they were allowed to
  struct Circuit {
    double draw_w = 0;  ///< at what is sent
    double scale = 1;   ///< below 1: its lamps are held down in proportion to keep the limit
  };
  std::vector<Circuit> circuits;  ///< by circuit of the studio
  struct CueState {
    std::int32_t playing = -1;  ///< index into the list; -1 = none
    double number = 0;          ///< of the one that plays
    std::uint32_t cues = 0;
    double follow_s = -1;  ///< until the next goes by itself; -1 = it waits for a go
  } cue;
  struct Port {
    std::uint16_t universe = 0;
    std::uint8_t health = 0;  ///< ports::PortHealth
    double rate_hz = 0;       ///< asked for
    std::uint64_t frames = 0, failed = 0;
    std::uint64_t late = 0;    ///< left more than half a period after their deadline
    std::uint64_t missed = 0;  ///< deadlines at which nothing left
    /// |gap between two frames - period|, since the start: median, 99 and 99.9 per cent.
    double jitter_us_p50 = 0, jitter_us_p99 = 0, jitter_us_p999 = 0;
    std::array<std::uint8_t, 512> slots{};  ///< as last sent; slot n is slots[n - 1]
  };
  std::vector<Port> ports;
  /// By studio::asked_of_brain: how often, or how many detents, surfaces have asked for each since
  /// `asks_id`, which is another after every start of the hand.
  std::vector<double> asks;
  std::uint64_t asks_id = 0;
  bool real_time = false;  ///< SCHED_FIFO and locked memory were granted
  bool dry_run = false;    ///< nothing physical is open
};

}  // namespace chiaro::rig
