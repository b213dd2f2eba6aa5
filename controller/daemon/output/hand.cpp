// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/hand.h"

namespace chiaro::daemon {

void Hand::frame(ports::Clock& clock) {
  if (Show* next = incoming_.exchange(nullptr, std::memory_order_acq_rel)) {
    next->take_over(*show_);
    outgoing_.store(show_.release(), std::memory_order_release);
    show_.reset(next);
  }
  if (const std::uint64_t wish = wish_.load(std::memory_order_acquire); wish != seen_) {
    seen_ = wish;
    told_ = clock.now();
    show_->set_blackout((wish & 1u) != 0);
  }
  show_->frame(clock);
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

}  // namespace chiaro::daemon
