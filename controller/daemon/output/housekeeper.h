// SPDX-License-Identifier: Apache-2.0
// Everything around the output loop that may take its time: looking for the brain's box, opening
// lost ports again, keeping the last levels, reading the studio file again, telling people.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/output/desk.h"
#include "controller/daemon/output/hand.h"
#include "controller/daemon/output/recorder.h"
#include "controller/ports/world.h"

namespace chiaro::daemon {

/// Runs on a thread of its own; `reload_now` may be called from others.
class Housekeeper {
 public:
  static constexpr ports::Duration kTick = std::chrono::milliseconds(50);
  static constexpr ports::Duration kSaveEvery = std::chrono::seconds(1);

  Housekeeper(Hand& hand, const std::filesystem::path& studio_file, const Show::Options& options,
              ports::World& world);

  /// Control surfaces that follow what is being sent; before the first round. It outlives this.
  void serve(Desk& desk) { desk_ = &desk; }
  /// One round; the caller sleeps until `kTick` later.
  void tick();
  /// No more waiting for the loop: it ends.
  void end();
  /// After the loop and the last round: keeps the levels of the last frame.
  void finish();
  /// Asks for a reload and waits for its outcome; `patience` in real time. Thread-safe.
  core::Result<core::Done> reload_now(ports::Duration patience);
  /// Thread-safe.
  Recorder& recorder() { return recorder_; }
  /// The newest report, copied. Thread-safe.
  rig::Sent newest_report() const;
  /// How the motors with an address of their own stand, by their own word. Thread-safe.
  struct Axis {
    std::uint16_t universe = 0;
    ports::AxisReport report;
  };
  std::vector<Axis> axes_now() const;
  /// The studio that is being sent, copied. Thread-safe.
  studio::Studio studio_now() const;

 private:
  void look_for_brain();
  void read_report();
  void read_axes();
  void tell_changes();
  void mend_ports();
  bool is_due_for_mending(const PortSlot& slot);
  void wait_longer(const PortSlot& slot);
  void save_if_due();
  void save_now();
  void wait_a_tick();
  core::Result<core::Done> reload();
  bool swap_in(std::unique_ptr<Show> next);
  void say(const core::Problems& problems);

  Hand& hand_;
  Show* show_;  ///< what the loop runs: only this class swaps it
  const std::filesystem::path studio_file_;
  const Show::Options options_;
  ports::World& world_;
  Desk* desk_ = nullptr;
  Recorder recorder_;

  std::uint64_t brain_box_ = 0;  ///< identity of the box that was last given or refused
  std::unique_ptr<BoxReader> report_reader_;
  std::vector<std::uint64_t> report_words_;
  mutable std::mutex report_mutex_;
  rig::Sent report_;
  rig::Sent spare_;  ///< this thread's: where the next report is read into
  bool resized_ = false;
  studio::Studio studio_;   ///< under the report's mutex
  std::vector<Axis> axes_;  ///< the same

  struct Lost {
    ports::TimePoint next;
    ports::Duration wait;
  };
  std::map<const PortSlot*, Lost> lost_;
  std::optional<rig::Held> saved_;
  ports::TimePoint saved_at_;
  bool save_failed_ = false;
  std::optional<rig::Caution> told_;
  std::atomic<bool> ending_{false};

  std::mutex reload_mutex_;
  std::condition_variable reload_done_;
  std::uint64_t reloads_asked_ = 0, reloads_done_ = 0;
  core::Problems reload_problems_;
};

}  // namespace chiaro::daemon
