// SPDX-License-Identifier: Apache-2.0
// One Modbus line and whose turn it is on it. A bus is a hundred times slower than DMX and has one
// master: everything on it goes through this scheduler, one transaction at a time, so that a device
// that does not answer costs the others one timeout now and then and nothing more.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "controller/ports/clock.h"
#include "controller/ports/devices.h"

namespace chiaro::drivers::modbus {

/// One device's share of the bus: what it wants to say next. Called by the bus's thread alone, but
/// for `urgent` and `due`, which look at atomics.
class Client {
 public:
  virtual ~Client() = default;
  /// When it next wants the line; TimePoint::max() = nothing to say.
  virtual ports::TimePoint due(ports::TimePoint now) const = 0;
  /// Goes before everybody else (a motion stop).
  virtual bool urgent() const { return false; }
  /// One transaction.
  virtual ports::ModbusLink::Outcome turn(ports::ModbusLink& link, ports::TimePoint now) = 0;
  /// Its turn has ended, with the device's answer or without.
  virtual void spoken(ports::TimePoint) {}
  /// The line was lost and is back: nobody need be waited for, nothing is known any more.
  virtual void line_opened() {}
};

/// How long a device that fails is left alone: 0.25 s, doubling to 5 s; one success ends it.
class Patience {
 public:
  void failed(ports::TimePoint now) {
    wait_ = std::clamp(2 * wait_, kFirst, kLast);
    until_ = now + wait_;
  }
  void worked() { wait_ = {}, until_ = {}; }
  ports::TimePoint until() const { return until_; }
  bool tried() const { return wait_.count() > 0; }

 private:
  static constexpr ports::Duration kFirst = std::chrono::milliseconds(250),
                                   kLast = std::chrono::seconds(5);
  ports::Duration wait_{};
  ports::TimePoint until_;
};

class Bus {
 public:
  static constexpr const char* kKind = "Modbus line";

  /// `threaded`: a thread of its own takes the turns; else the owner calls `step`. Both references
  /// outlive this.
  Bus(ports::Devices& devices, ports::Clock& clock, ports::ModbusLine line, bool threaded);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Opens the line if it is not open, now. Thread-safe.
  core::Result<core::Done> open();
  bool is_open() const { return open_.load(std::memory_order_acquire); }
  /// A client takes turns from now on, until it is removed. Thread-safe; waits for a turn to end.
  void add(Client& client);
  void remove(Client& client);
  /// Somebody has something new to say. Real-time.
  void wake();

  /// One turn, of the client that is urgent, else of the one whose time came first; false when
  /// nobody is due. Opens a lost line again when it is time.
  bool step(ports::TimePoint now);
  /// When a turn is next due.
  ports::TimePoint next(ports::TimePoint now) const;
  bool threaded() const { return threaded_; }

 private:
  void run();
  Client* choose(ports::TimePoint now) const;
  core::Result<core::Done> open_locked();

  ports::Devices& devices_;
  ports::Clock& clock_;
  const ports::ModbusLine line_;
  const bool threaded_;
  mutable std::mutex mutex_;
  std::unique_ptr<ports::ModbusLink> link_;
  std::vector<Client*> clients_;
  mutable std::size_t last_ = 0;  ///< whose turn it was: the others go first among equals
  Patience reopening_;
  std::atomic<bool> open_{false}, ending_{false}, awake_{false};
  std::binary_semaphore work_{0};
  std::thread thread_;
};

}  // namespace chiaro::drivers::modbus
