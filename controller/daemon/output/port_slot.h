// SPDX-License-Identifier: Apache-2.0
// One output port with its pace: absolute deadlines, what was late, and how the port is lent to
// the housekeeper when it must be opened again.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "controller/daemon/output/jitter.h"
#include "controller/daemon/output/port_writer.h"
#include "controller/ports/output.h"
#include "controller/rig/wanted.h"
#include "drivers/registry.h"

namespace chiaro::daemon {

/// The loop's, but for the functions that say otherwise. A port keeps its protocol state (its
/// sequence above all) across reopening and reloading, so receivers see one unbroken stream.
class PortSlot {
 public:
  /// A port that may wait for its device gets its thread here, which opens it; the others have been
  /// opened by the caller. `clock` outlives this; `real_time`: the thread may ask for a turn.
  PortSlot(std::string driver, drivers::OutputSettings settings,
           std::unique_ptr<ports::OutputPort> port, double rate_hz, ports::Clock& clock,
           bool real_time);

  /// The first frame leaves at `start`.
  void start(ports::TimePoint start) { next_ = start; }
  void set_rate(double rate_hz);
  ports::TimePoint next() const { return next_; }
  bool due(ports::TimePoint now) const { return next_ <= now; }
  /// Real-time. Sends when due, at the latest with the next `flush` of any port, and moves on to
  /// the next deadline of the grid that lies ahead.
  void send(const ports::DmxFrame& frame, ports::Clock& clock);
  /// Real-time; after the last port of a frame.
  void flush();
  /// Time of the last attempt: what was decided before it is on the wire, if the wire is there (or
  /// will be at the device's next turn, if that keeps its callers waiting).
  ports::TimePoint tried() const { return tried_; }
  /// After the loop has ended or has put this down.
  void release(ports::TimePoint now);
  void report(rig::Sent::Port& into) const;

  /// Housekeeper: health as the loop last saw it.
  ports::PortHealth health() const {
    return writer_ ? writer_->report().health : health_.load(std::memory_order_acquire);
  }
  /// Housekeeper: the port's own thread, which opens it again when asked; null for most ports.
  PortWriter* writer() { return writer_.get(); }
  /// Housekeeper, of the others: asks for the port, then, once `lent`, may open it; gives it back.
  void ask() { lending_.store(Lending::asked, std::memory_order_release); }
  bool lent() const { return lending_.load(std::memory_order_acquire) == Lending::lent; }
  void give_back() { lending_.store(Lending::at_work, std::memory_order_release); }
  ports::OutputPort& port() { return *port_; }

  const std::string& driver() const { return driver_; }
  const drivers::OutputSettings& settings() const { return settings_; }

 private:
  enum class Lending : std::uint8_t { at_work, asked, lent };
  bool away();
  void send_here(const ports::DmxFrame& frame, ports::TimePoint now);
  void measure(ports::TimePoint now);
  void move_on(ports::TimePoint now);

  const std::string driver_;
  const drivers::OutputSettings settings_;
  const std::unique_ptr<ports::OutputPort> port_;
  std::unique_ptr<PortWriter> writer_;  ///< uses the port: ends before it
  double rate_hz_ = 0;
  ports::Duration period_{};
  ports::TimePoint next_, tried_, sent_;
  bool any_ = false, pending_ = false;
  std::uint64_t late_ = 0, missed_ = 0;
  Jitter jitter_;
  double p50_ = 0, p99_ = 0, p999_ = 0;  ///< refreshed about once a second: counting costs
  std::atomic<Lending> lending_{Lending::at_work};
  std::atomic<ports::PortHealth> health_{ports::PortHealth::closed};
};

}  // namespace chiaro::daemon
