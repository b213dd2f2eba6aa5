// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/port_writer.h"

#include <utility>

#include "controller/daemon/output/real_time.h"

namespace chiaro::daemon {

PortWriter::PortWriter(ports::OutputPort& port, ports::Clock& clock, ports::Duration period,
                       bool real_time)
    : port_(port), clock_(clock), period_(period) {
  wake();
  thread_ = std::thread([this, real_time] {
    if (real_time) take_turn_below_loop();
    run();
  });
}

PortWriter::~PortWriter() {
  ending_ = true;
  wake();
  thread_.join();
}

void PortWriter::run() {
  while (true) {
    work_.acquire();
    awake_.exchange(false, std::memory_order_acq_rel);  // sees all that was laid down before
    if (ending_) return;
    if (mend_.exchange(false, std::memory_order_acq_rel)) open();
    if (const ports::DmxFrame* frame = newest_.take()) port_.send(*frame, clock_.now());
    publish();
    attempted_.store(true, std::memory_order_release);
  }
}

void PortWriter::open() {
  const auto opened = port_.open();
  const std::string words = opened ? "" : core::to_string(opened.problems());
  if (words != told_ && !opened) {
    const std::scoped_lock lock(mutex_);
    problems_ = opened.problems();
  }
  told_ = words;
}

void PortWriter::publish() {
  const ports::PortReport report = port_.report();
  health_.store(report.health, std::memory_order_release);
  sent_.store(report.frames_sent, std::memory_order_relaxed);
  failed_.store(report.frames_failed, std::memory_order_relaxed);
  reconnects_.store(report.reconnects, std::memory_order_relaxed);
  measure(report.left);
}

void PortWriter::measure(ports::TimePoint left) {
  if (left == left_) return;
  const bool first = left_ == ports::TimePoint{};
  const ports::Duration gap = left - std::exchange(left_, left);
  if (first) return;
  jitter_.add(gap - period_.load(std::memory_order_relaxed));
  constexpr std::uint64_t kEvery = 32;  // counting costs
  if (jitter_.total() % kEvery != 1) return;
  constexpr std::array kShares{0.5, 0.99, 0.999};
  for (std::size_t i = 0; i < kShares.size(); ++i)
    jitter_us_[i].store(jitter_.microseconds(kShares[i]), std::memory_order_relaxed);
  measured_.store(true, std::memory_order_release);
}

std::optional<std::array<double, 3>> PortWriter::jitter_us() const {
  if (!measured_.load(std::memory_order_acquire)) return std::nullopt;
  std::array<double, 3> all{};
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = jitter_us_[i].load(std::memory_order_relaxed);
  return all;
}

ports::PortReport PortWriter::report() const {
  return {health_.load(std::memory_order_acquire),
          sent_.load(std::memory_order_relaxed),
          failed_.load(std::memory_order_relaxed),
          reconnects_.load(std::memory_order_relaxed),
          {}};
}

core::Problems PortWriter::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

}  // namespace chiaro::daemon
