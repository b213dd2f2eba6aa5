// SPDX-License-Identifier: Apache-2.0
// The patch of a whole studio, worked out once: which degree of freedom goes to which slots by
// which law. The output encodes with it and the virtual studio decodes with it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "controller/core/dof.h"
#include "controller/core/result.h"
#include "controller/ports/output.h"
#include "controller/rig/governor.h"
#include "controller/studio/studio.h"

namespace chiaro::patch {

/// How levels become slots, per channel of a fixture's mode:
/// * a channel without a DOF sends its constant for ever (a strobe at "open");
/// * `intensity` goes through the inverse of the dimmer curve, so that light follows the level;
/// * in a mode without an intensity channel the emitter drives (red, green, …) are the dimmers:
///   each is multiplied by the level and goes through the inverse curve. With an intensity channel
///   the drives are sent as they are;
/// * every other DOF goes through the channel's segments;
/// * a channel that trims is sent what the coarse channel, already rounded, leaves over; one that
///   repeats is sent what the controlling one is; a head's pan and tilt are counted as it is
///   mounted;
/// * 1, 2 or 3 slots, most significant first, rounded once, here.
/// A DOF that a hand sets sends 0, one without a value the channel's rest, or 0. Slots that nobody
/// has are 0.
class Plan {
 public:
  /// Precondition: the studio came from load_studio (addresses and modes are right). Warnings name
  /// fixtures whose patch reaches no wire.
  static Plan of(const studio::Studio& studio, core::Problems* warnings = nullptr);

  /// One entry per output of the studio and per patched universe, ascending.
  std::span<const std::uint16_t> universes() const { return universes_; }
  std::size_t fixtures() const { return fixtures_; }
  /// Blank frames in the order of `universes`.
  std::vector<ports::DmxFrame> blank_frames() const;

  /// Writes every slot of every frame. Precondition: frames.size() == universes().size().
  /// Real-time.
  void encode(const rig::AllowedLevels& levels, std::span<ports::DmxFrame> frames) const;

  /// What lamps that get these frames are told, by fixture index. The same table backwards: in a
  /// mode without an intensity channel the level is the strongest drive and the drives are given
  /// relative to it, so that the light is the same. DOFs without a channel stay absent. Real-time.
  void decode(std::span<const ports::DmxFrame> frames,
              std::span<core::FixtureState> fixtures) const;

  /// One line of the patch sheet per channel, in the order of universe and address.
  struct Line {
    std::size_t fixture = 0;
    std::uint16_t universe = 1;
    int first = 1, last = 1;  ///< slots, 1..512
    std::string channel;
    std::string law;  ///< "intensity, 16 bit", "open 255, 8 bit"
  };
  std::vector<Line> sheet() const;

 private:
  enum class Law : std::uint8_t { constant, level, dimmed_drive, segments, by_hand };
  struct Slot {
    std::uint32_t fixture = 0;
    std::uint32_t universe = 0;         ///< index into universes_
    std::array<std::uint16_t, 3> at{};  ///< 0..511, most significant first
    std::uint8_t bytes = 1;
    studio::ChannelUse use = studio::ChannelUse::controls;
    std::int32_t trim = -1;  ///< of a controlling slot: the one that trims it
    Law law = Law::constant;
    core::Dof dof = core::Dof::intensity;
    std::uint32_t constant = 0;  ///< raw, also at rest
    std::uint32_t curve = 0;     ///< index into curves_
    std::vector<studio::Segment> segments;
    std::string name;
  };
  void add(const studio::Fixture& fixture, std::size_t index);
  Slot slot_of(const studio::Fixture& fixture, std::size_t index, const studio::Channel& channel,
               const studio::DmxPatch& patch, bool no_dimmer) const;
  void add_far_motor(const studio::Fixture& fixture, std::size_t index);
  void join_trims(std::size_t from);
  static std::string law_in_words(const Slot& slot);
  double meaning(const Slot& slot, const core::FixtureState& state) const;
  void put(const Slot& slot, const core::FixtureState& state, ports::DmxFrame& frame) const;
  void read(const Slot& slot, const ports::DmxFrame& frame, core::FixtureState& state) const;

  std::size_t fixtures_ = 0;
  std::vector<std::uint16_t> universes_;
  std::vector<studio::DimmerCurve> curves_;  ///< by fixture index
  std::vector<Slot> slots_;
  std::vector<std::uint8_t> no_dimmer_;  ///< by fixture: 1 = the drives are the dimmers
};

}  // namespace chiaro::patch
