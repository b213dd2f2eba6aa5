// SPDX-License-Identifier: Apache-2.0
// Who has the say on each degree of freedom, and the fade on the way there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "controller/rig/fade.h"
#include "controller/rig/flash_guard.h"
#include "controller/rig/lamp.h"
#include "controller/rig/wanted.h"

namespace chiaro::rig {

inline constexpr int kDefault = -1;  ///< the winner when no source has an opinion

/// What one DOF is doing.
struct Track {
  Fade fade;
  FlashGuard guard;
  double sent = 0;  ///< before masters: where the next fade starts
  int winner = kDefault;
};

/// The sources' words and what follows from them. Everything but `add` is real-time.
class Sources {
 public:
  void add(const Lamp& lamp, const core::FixtureState* held);

  /// Takes the words of the brain's sources, or, with `cue`, of the hand's own alone, and turns
  /// every DOF towards its winner. `woken[i]` is set for lamps whose way has changed.
  void hear(std::span<const Lamp> lamps, std::span<const SourceState, kSources> words,
            ports::TimePoint now, std::vector<std::uint8_t>& woken);
  /// Lamps that move in black take their word from `ahead`.
  void hear_cue(std::span<const Lamp> lamps, const SourceState& cue, const SourceState& ahead,
                std::span<const Marks> marks, ports::TimePoint now,
                std::vector<std::uint8_t>& woken);
  bool has_cue() const { return cue_; }
  /// One DOF of lamp i as its own fader has it, at once.
  void hear_own(std::size_t i, std::span<const Lamp> lamps, core::Dof dof, double value,
                ports::TimePoint now, std::vector<std::uint8_t>& woken);
  /// Lamp i's own faders let go.
  void release_own(std::size_t i, std::span<const Lamp> lamps, double fade_s, ports::TimePoint now,
                   std::vector<std::uint8_t>& woken);

  Track& track(std::size_t lamp, std::size_t d) { return tracks_[lamp * core::kDofs + d]; }
  const Track& track(std::size_t lamp, std::size_t d) const {
    return tracks_[lamp * core::kDofs + d];
  }
  const SourceState& word(std::size_t source) const { return words_[source]; }
  double progress_of(std::size_t source, ports::TimePoint now) const {
    return progress(start_[source], words_[source].fade_s, now);
  }
  /// The fades that were taken before a power cut: hearing of them again starts none of them.
  void remember(const std::array<std::uint64_t, kSources>& fade_ids);
  void stand_on(std::span<const Lamp> lamps, const SourceState& cue);
  /// After a power cut: its own faders stand where they stood. Starts no fade.
  void recall_own(std::size_t i, const Lamp& lamp, const core::FixtureState& own);
  /// Lamp i goes on where lamp j of `before` is.
  void carry(std::size_t i, const Lamp& lamp, const Sources& before, std::size_t j,
             const Lamp& was);
  void carry_fades(const Sources& before);

 private:
  bool hear_source(std::size_t s, const Lamp& lamp, std::size_t i, const SourceState& word);
  void begin(std::size_t s, std::uint64_t id, double fade_s, ports::TimePoint now);
  void end_cue(ports::TimePoint now, double fade_s);
  void end_own(ports::TimePoint now, double fade_s);
  void retarget_all(std::span<const Lamp> lamps, ports::TimePoint now,
                    std::vector<std::uint8_t>& woken);
  int winner(std::size_t lamp, core::Dof dof) const;
  double seconds_for(const Track& track, int winner, ports::TimePoint now) const;
  bool retarget(std::size_t i, const Lamp& lamp, core::Dof dof, ports::TimePoint now);

  std::vector<Track> tracks_;  ///< lamp * kDofs + DOF
  std::array<SourceState, kSources> words_;
  std::array<ports::TimePoint, kSources> start_{};
  std::array<bool, kSources> fresh_{};  ///< its fade id is new in the word being taken
  std::vector<std::uint8_t> changed_;   ///< by lamp, of the word being taken
  bool cue_ = false;
};

}  // namespace chiaro::rig
