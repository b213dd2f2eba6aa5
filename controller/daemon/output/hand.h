// SPDX-License-Identifier: Apache-2.0
// The output loop's own state and the doors through which other threads reach it. Nobody waits at
// a door: a wish is laid down, the loop takes it at its next frame.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "controller/daemon/output/show.h"

namespace chiaro::daemon {

class Hand {
 public:
  explicit Hand(std::unique_ptr<Show> show) : show_(std::move(show)) {}
  ~Hand() {
    delete incoming_.load();
    delete outgoing_.load();
    delete cues_in_.load();
    delete cues_out_.load();
  }
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;

  // The loop; real-time.
  void start(ports::TimePoint start) { show_->start(start); }
  void frame(ports::Clock& clock);
  ports::TimePoint next_deadline() const { return show_->next_deadline(); }
  /// Says how things stand after the last frame.
  void finish() { show_->report_now(); }

  // Any thread.

  /// Lays down a wish and returns its number; `taken` says when it is on the wire of every port.
  /// It has a way of its own, which nothing else can fill.
  std::uint64_t wish_blackout(bool on);
  bool taken(std::uint64_t wish) const { return taken_.load(std::memory_order_acquire) >= wish; }
  /// The same for everything else; 0 when the loop has not kept up. `obeyed` says when it has been
  /// decided on.
  std::uint64_t wish(const Wish& wish);
  bool obeyed(std::uint64_t wish) const { return obeyed_.load(std::memory_order_acquire) >= wish; }
  /// When the newest obeyed wish was: what is reported of then or later shows it.
  std::int64_t obeyed_at_ns() const { return obeyed_at_ns_.load(std::memory_order_acquire); }
  std::uint64_t frames() const { return frames_.load(std::memory_order_relaxed); }

  // One thread, one list at a time: hands the loop other cues; the old list comes back.
  void offer_cues(std::unique_ptr<rig::CueList> cues) {
    delete cues_in_.exchange(cues.release(), std::memory_order_acq_rel);
  }
  std::unique_ptr<rig::CueList> collect_cues() {
    return std::unique_ptr<rig::CueList>(cues_out_.exchange(nullptr, std::memory_order_acq_rel));
  }

  // The housekeeper, one swap at a time.

  /// Hands the loop another show, which it takes at its next frame.
  void offer(std::unique_ptr<Show> show) {
    incoming_.store(show.release(), std::memory_order_release);
  }
  /// From its next frame on the loop puts what it sends on that tape too, for good.
  void record_to(LiveTape& tape) { tape_.store(&tape, std::memory_order_release); }
  /// The show that the loop has put down; null until it has.
  std::unique_ptr<Show> collect() {
    return std::unique_ptr<Show>(outgoing_.exchange(nullptr, std::memory_order_acq_rel));
  }
  /// While no loop runs, or for the housekeeper between swaps.
  Show& show() { return *show_; }

 private:
  void take_what_was_offered();
  void take_wishes(ports::TimePoint now);

  static constexpr std::uint64_t kWishes = 64;
  std::unique_ptr<Show> show_;
  std::atomic<Show*> incoming_{nullptr}, outgoing_{nullptr};
  std::atomic<rig::CueList*> cues_in_{nullptr}, cues_out_{nullptr};
  std::atomic<LiveTape*> tape_{nullptr};
  std::atomic<std::uint64_t> wish_{0};  ///< number * 2 + on
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<std::uint64_t> frames_{0};
  std::uint64_t seen_ = 0;  ///< the wish that the show has been told
  ports::TimePoint told_;

  std::mutex wishing_;  ///< of those who wish, among themselves
  std::array<Wish, kWishes> wishes_;
  std::atomic<std::int64_t> obeyed_at_ns_{0};
  std::atomic<std::uint64_t> wished_{0}, obeyed_{0};  ///< how many were laid down, and decided on
};

}  // namespace chiaro::daemon
