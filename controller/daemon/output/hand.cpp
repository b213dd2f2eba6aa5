// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/hand.h"

namespace chiaro::daemon {

void Hand::take_what_was_offered() {
  if (Show* next = incoming_.exchange(nullptr, std::memory_order_acq_rel)) {
    next->take_over(*show_);
    outgoing_.store(show_.release(), std::memory_order_release);
    show_.reset(next);
  }
  if (rig::CueList* list = cues_in_.exchange(nullptr, std::memory_order_acq_rel)) {
    std::unique_ptr<rig::CueList> cues(list);
    // A list that was made for the studio of before goes back as it came.
    if (cues->studio == show_->studio().fingerprint) show_->take_cues(cues);
    cues_out_.store(cues.release(), std::memory_order_release);
  }
}

void Hand::take_wishes(ports::TimePoint now) {
  const std::uint64_t laid_down = wished_.load(std::memory_order_acquire);
  std::uint64_t done = obeyed_.load(std::memory_order_relaxed);
  if (done == laid_down) return;
  for (; done < laid_down; ++done) show_->obey(wishes_[done % kWishes], now);
  obeyed_at_ns_.store(now.time_since_epoch().count(), std::memory_order_release);
  obeyed_.store(done, std::memory_order_release);
}

void Hand::frame(ports::Clock& clock) {
  take_what_was_offered();
  const ports::TimePoint now = clock.now();
  take_wishes(now);
  if (const std::uint64_t wish = wish_.load(std::memory_order_acquire); wish != seen_) {
    seen_ = wish;
    told_ = now;
    show_->set_blackout((wish & 1u) != 0);
  }
  show_->frame(clock, tape_.load(std::memory_order_acquire));
  if (show_->all_tried_since(told_)) taken_.store(seen_ / 2, std::memory_order_release);
  frames_.fetch_add(1, std::memory_order_relaxed);
}

std::uint64_t Hand::wish_blackout(bool on) {
  std::uint64_t old = wish_.load(std::memory_order_relaxed), wish = 0;
  do {
    wish = (old / 2 + 1) * 2 + (on ? 1 : 0);
  } while (!wish_.compare_exchange_weak(old, wish, std::memory_order_acq_rel));
  return wish / 2;
}

std::uint64_t Hand::wish(const Wish& wish) {
  const std::scoped_lock lock(wishing_);
  const std::uint64_t number = wished_.load(std::memory_order_relaxed);
  if (number - obeyed_.load(std::memory_order_acquire) >= kWishes) return 0;
  wishes_[number % kWishes] = wish;
  wished_.store(number + 1, std::memory_order_release);
  return number + 1;
}

}  // namespace chiaro::daemon
