// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/port_slot.h"

#include <cmath>
#include <utility>

namespace chiaro::daemon {

PortSlot::PortSlot(std::string driver, drivers::OutputSettings settings,
                   std::unique_ptr<ports::OutputPort> port, double rate_hz, ports::Clock& clock,
                   bool real_time)
    : driver_(std::move(driver)), settings_(std::move(settings)), port_(std::move(port)) {
  set_rate(rate_hz);
  health_ = port_->report().health;
  if (port_->blocks()) writer_ = std::make_unique<PortWriter>(*port_, clock, period_, real_time);
}

void PortSlot::set_rate(double rate_hz) {
  rate_hz_ = rate_hz;
  period_ = ports::Duration(std::llround(1e9 / rate_hz));
  if (writer_) writer_->set_period(period_);
}

bool PortSlot::away() {
  Lending lending = Lending::asked;  // in one step: who asked may give up meanwhile
  if (lending_.compare_exchange_strong(lending, Lending::lent, std::memory_order_acq_rel))
    return true;
  return lending != Lending::at_work;
}

void PortSlot::move_on(ports::TimePoint now) {
  if (now - next_ > period_ / 2) ++late_;
  next_ += period_;
  if (next_ > now) return;
  const auto skipped = (now - next_) / period_ + 1;
  missed_ += static_cast<std::uint64_t>(skipped);
  next_ += skipped * period_;
}

void PortSlot::send(const ports::DmxFrame& frame, ports::Clock& clock) {
  const ports::TimePoint now = clock.now();
  tried_ = now;
  move_on(now);
  if (writer_) {
    writer_->put(frame);
    measure(now);
  } else if (away()) {
    ++missed_;
    any_ = false;
  } else {
    send_here(frame, now);
    measure(now);
  }
}

void PortSlot::send_here(const ports::DmxFrame& frame, ports::TimePoint now) {
  port_->send_later(frame, now);
  pending_ = true;
}

void PortSlot::flush() {
  if (!std::exchange(pending_, false)) return;
  port_->flush();
  health_.store(port_->report().health, std::memory_order_release);
}

void PortSlot::measure(ports::TimePoint now) {
  if (any_) jitter_.add((now - sent_) - period_);
  any_ = true;
  sent_ = now;
  const auto every = static_cast<std::uint64_t>(rate_hz_) + 1;
  if ((jitter_.total() + settings_.universe) % every == 0) {
    p50_ = jitter_.microseconds(0.5);
    p99_ = jitter_.microseconds(0.99);
    p999_ = jitter_.microseconds(0.999);
  }
}

void PortSlot::release(ports::TimePoint now) {
  writer_.reset();
  port_->release(now);
}

void PortSlot::report(rig::Sent::Port& into) const {
  into.universe = settings_.universe;
  into.rate_hz = rate_hz_;
  into.late = late_;
  into.missed = missed_;
  into.jitter_us_p50 = p50_;
  into.jitter_us_p99 = p99_;
  into.jitter_us_p999 = p999_;
  if (const auto wire = writer_ ? writer_->jitter_us() : std::nullopt) {
    into.jitter_us_p50 = (*wire)[0];
    into.jitter_us_p99 = (*wire)[1];
    into.jitter_us_p999 = (*wire)[2];
  }
  into.health = static_cast<std::uint8_t>(health());
  if (lending_.load(std::memory_order_acquire) != Lending::at_work) return;
  const ports::PortReport report = writer_ ? writer_->report() : port_->report();
  into.frames = report.frames_sent;
  into.failed = report.frames_failed;
}

}  // namespace chiaro::daemon
