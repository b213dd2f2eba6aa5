// SPDX-License-Identifier: Apache-2.0
// Keeps what the hand sends in a file, every frame of every universe, beside the output loop.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "controller/core/result.h"
#include "controller/daemon/output/hand.h"
#include "controller/daemon/output/tape_file.h"

namespace chiaro::daemon {

/// Thread-safe.
class Recorder {
 public:
  /// `hand` outlives this and no longer runs when this ends.
  explicit Recorder(Hand& hand) : hand_(hand) {}

  struct State {
    bool on = false;
    std::string file;
    double seconds = 0;
    std::uint64_t ticks = 0, bytes = 0, lost = 0;
  };
  core::Result<core::Done> start(const std::filesystem::path& file, const studio::Studio& studio);
  /// What was recorded; a problem when nothing was being.
  core::Result<State> stop();
  State state() const;
  /// Writes down what has been sent since. Housekeeper, ten times a second or more. A disk that is
  /// full ends the recording; what is told then is told once.
  core::Problems tick();

 private:
  core::Result<core::Done> drain();
  State state_now() const;

  Hand& hand_;
  mutable std::mutex mutex_;
  std::unique_ptr<LiveTape>
      tape_;  ///< made for the first recording; the loop knows it from then on
  std::unique_ptr<TapeWriter> writer_;
  std::string file_;
};

}  // namespace chiaro::daemon
