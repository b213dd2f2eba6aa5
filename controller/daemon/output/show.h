// SPDX-License-Identifier: Apache-2.0
// One studio being sent: its governor, its patch and its ports, with the two boxes through which
// the brain is heard and answered. Built off the loop; run by it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/box.h"
#include "controller/daemon/output/live_tape.h"
#include "controller/daemon/output/port_slot.h"
#include "controller/daemon/output/tried_slots.h"
#include "controller/daemon/output/wish.h"
#include "controller/patch/plan.h"
#include "controller/ports/world.h"
#include "controller/rig/cue_stack.h"
#include "controller/rig/governor.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

class Show {
 public:
  struct Options {
    bool dry_run = false;
    bool real_time = false;  ///< threads of ports that wait for their device ask for a turn
    std::array<std::uint8_t, 16> cid{};
    drivers::Surroundings* around = nullptr;  ///< outlives every show
  };
  /// Opens what `before` does not have open already; warnings (a port that cannot be opened now is
  /// tried again later) go to `warnings`. Fails when its box cannot be laid out.
  static core::Result<std::unique_ptr<Show>> make(const studio::Studio& studio,
                                                  const Options& options, ports::World& world,
                                                  const rig::Held* held, const Show* before,
                                                  core::Problems& warnings);
  ~Show();
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;

  // The loop's side; real-time.

  /// Goes on where `before` is: levels by fixture name, ports that stay, their pace.
  void take_over(Show& before);
  void start(ports::TimePoint start);
  ports::TimePoint next_deadline() const;
  /// Hears the brain, decides the levels and sends every port that is due. Ends with a report when
  /// one is due: ten a second, and at once when caution or blackout have changed.
  /// What leaves is put on `tape` too, if there is one.
  void frame(ports::Clock& clock, LiveTape* tape = nullptr);
  void report_now();
  void set_blackout(bool on) { governor_.set_blackout(on); }
  void obey(const Wish& wish, ports::TimePoint now);
  /// The old list comes back in `list`.
  void take_cues(std::unique_ptr<rig::CueList>& list) { cues_.take(list); }
  /// When every port has sent, or tried to, at or after `since`.
  bool all_tried_since(ports::TimePoint since) const;
  void set_real_time(bool granted) { report_.real_time = granted; }

  // The housekeeper's side.

  /// A newly opened box of the brain's, for the loop to read from the next frame on.
  void give_reader(std::unique_ptr<BoxReader> reader);
  /// There is a box, but it cannot be read: hold.
  void refuse_brain() { refused_.store(true, std::memory_order_release); }
  const std::vector<std::unique_ptr<PortSlot>>& ports() const { return ports_; }
  const studio::Studio& studio() const { return studio_; }
  /// Says goodbye on every port (after the loop has ended or moved to another show).
  void release(ports::TimePoint now);

 private:
  Show(const studio::Studio& studio, const Options& options, ports::TimePoint now,
       const rig::Held* held);
  void add_port(const studio::Output& output, const Options& options, const Show* before,
                core::Problems& warnings);
  void recall_cues(std::unique_ptr<rig::CueList> list, const rig::Held* held);
  void play(const rig::Cue* cue, ports::TimePoint now);
  void obey_for(std::size_t fixture, const Wish& wish, ports::TimePoint now);
  void home(std::size_t fixture);
  void stop_motors();
  void obey_for_those_meant(const Wish& wish, ports::TimePoint now);
  void hear(ports::TimePoint now);
  bool report_is_due(ports::TimePoint now) const;

  const studio::Studio studio_;
  patch::Plan plan_;
  rig::Governor governor_;
  rig::CueStack cues_;
  std::vector<ports::DmxFrame> frames_;
  /// By fixture: the port and the slot of its motor, if it has an address of its own.
  struct Motor {
    std::ptrdiff_t port = -1;
    std::uint16_t slot = 0;
  };
  std::vector<Motor> motors_;
  bool motors_stopped_ = false;
  TriedSlots tried_;
  std::vector<std::unique_ptr<PortSlot>> ports_;  ///< one per output of the studio
  std::vector<std::size_t> frame_of_port_;        ///< index into frames_
  std::vector<double> rates_;
  ports::TimePoint last_frame_, last_report_;

  // What take_over needs, worked out when this was built.
  std::vector<std::ptrdiff_t> fixtures_before_, ports_before_;

  std::unique_ptr<BoxWriter> writer_;
  std::vector<std::uint64_t> sent_words_, wanted_words_;
  rig::Sent report_;
  rig::Wanted wanted_;
  std::unique_ptr<BoxReader> reader_;          ///< the loop's
  std::atomic<BoxReader*> incoming_{nullptr};  ///< housekeeper to loop
  std::atomic<BoxReader*> outgoing_{nullptr};  ///< and the old one back
  std::atomic<bool> refused_{false};
};

}  // namespace chiaro::daemon
