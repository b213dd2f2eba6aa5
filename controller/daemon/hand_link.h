// SPDX-License-Identifier: Apache-2.0
// The brain's end of the two boxes, and the hand's control socket: what any program needs to talk
// to `chiaro-output`. Nothing here ever makes the hand wait.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "controller/core/result.h"
#include "controller/ports/clock.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

/// A brain that has not posted for this long is silent: the hand holds. Post at least four times
/// as often, changed or not.
inline constexpr ports::Duration kBrainSilent = std::chrono::seconds(1);
inline constexpr ports::Duration kHeartbeat = kBrainSilent / 4;
/// A report older than this means that the hand is gone.
inline constexpr ports::Duration kHandSilent = std::chrono::seconds(1);

/// One per studio: after a reload open a new one (the lock passes on when the old one is destroyed
/// first). One thread at a time.
class HandLink {
 public:
  /// Takes the brain's lock in `runtime_folder` (made when missing) and lays out a box for this
  /// studio. The hand need not be running. Fails when another brain has the lock.
  static core::Result<std::unique_ptr<HandLink>> open(const std::filesystem::path& runtime_folder,
                                                      const studio::Studio& studio);
  ~HandLink();
  HandLink(const HandLink&) = delete;
  HandLink& operator=(const HandLink&) = delete;

  /// Stamps fingerprint and time and lays the word in the box. Precondition: every source's
  /// `fixtures` is empty or has one state per fixture of the studio.
  void post(rig::Wanted wanted, ports::TimePoint now);

  /// The hand's newest report: none when there has never been a valid one for this studio. Look at
  /// `sent_ns` (or ask `hand_alive`) for its age.
  std::optional<rig::Sent> report();
  /// True when the newest report is younger than kHandSilent.
  bool hand_alive(ports::TimePoint now);
  /// Why there is no report, in words for people; empty while there is one.
  const std::string& silence() const;

  /// What a starting brain posts first, so that nothing changes: the hand's sources, masters, fade
  /// ids, marks and latches as it reports them. Nothing when the hand is not there.
  std::optional<rig::Wanted> adopted();

 private:
  struct Parts;
  explicit HandLink(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// The control socket: works whether or not a brain runs. Each call blocks at most `patience`
/// (real time) and answers only after the hand has acted; thread-safe.
/// `hand_blackout`: the level on the wire has changed when this returns.
core::Result<core::Done> hand_blackout(const std::filesystem::path& runtime_folder, bool on,
                                       ports::Duration patience = std::chrono::seconds(2));
/// Asks the hand to read its studio file again; every problem of the file comes back.
core::Result<core::Done> hand_reload(const std::filesystem::path& runtime_folder,
                                     ports::Duration patience = std::chrono::seconds(10));
/// Anything that may be said to the hand (output/answers.h): its answer, one JSON object.
core::Result<std::string> hand_request(const std::filesystem::path& runtime_folder,
                                       const std::string& line,
                                       ports::Duration patience = std::chrono::seconds(4));
/// The hand's state as one JSON object (what `status` prints).
core::Result<std::string> hand_status(const std::filesystem::path& runtime_folder,
                                      ports::Duration patience = std::chrono::seconds(2));

}  // namespace chiaro::daemon
