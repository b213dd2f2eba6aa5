// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/modbus_bus.h"

#include <algorithm>

namespace chiaro::drivers::modbus {

using Outcome = ports::ModbusLink::Outcome;

Bus::Bus(ports::Devices& devices, ports::Clock& clock, ports::ModbusLine line, bool threaded)
    : devices_(devices), clock_(clock), line_(std::move(line)), threaded_(threaded) {
  if (threaded_) thread_ = std::thread([this] { run(); });
}

Bus::~Bus() {
  ending_.store(true, std::memory_order_release);
  wake();
  if (thread_.joinable()) thread_.join();
}

core::Result<core::Done> Bus::open() {
  const std::scoped_lock lock(mutex_);
  return open_locked();
}

core::Result<core::Done> Bus::open_locked() {
  if (link_) return core::Done{};
  auto link = devices_.open_modbus(line_);
  if (!link) return link.problems();
  link_ = std::move(*link);
  open_.store(true, std::memory_order_release);
  for (Client* one : clients_) one->line_opened();
  return core::Done{};
}

void Bus::add(Client& client) {
  const std::scoped_lock lock(mutex_);
  if (std::find(clients_.begin(), clients_.end(), &client) == clients_.end())
    clients_.push_back(&client);
}

void Bus::remove(Client& client) {
  const std::scoped_lock lock(mutex_);
  std::erase(clients_, &client);
}

void Bus::wake() {
  if (!awake_.exchange(true, std::memory_order_acq_rel)) work_.release();
}

Client* Bus::choose(ports::TimePoint now) const {
  Client* best = nullptr;
  ports::TimePoint first = ports::TimePoint::max();
  for (std::size_t i = 1; i <= clients_.size(); ++i) {
    Client* one = clients_[(last_ + i) % clients_.size()];
    if (one->urgent()) return one;
    const ports::TimePoint due = one->due(now);
    if (due <= now && due < first) first = due, best = one;
  }
  return best;
}

bool Bus::step(ports::TimePoint now) {
  const std::scoped_lock lock(mutex_);
  if (!link_) {
    if (now < reopening_.until() || clients_.empty()) return false;
    if (!open_locked()) {
      reopening_.failed(now);
      return false;
    }
    reopening_.worked();
  }
  Client* client = choose(now);
  if (client == nullptr) return false;
  last_ = static_cast<std::size_t>(std::find(clients_.begin(), clients_.end(), client) -
                                   clients_.begin());
  const Outcome outcome = client->turn(*link_, now);
  client->spoken(clock_.now());
  if (outcome == Outcome::gone) {
    link_.reset();
    open_.store(false, std::memory_order_release);
    reopening_.failed(now);
  }
  return true;
}

ports::TimePoint Bus::next(ports::TimePoint now) const {
  const std::scoped_lock lock(mutex_);
  if (!link_) return std::max(now, reopening_.until());
  ports::TimePoint first = ports::TimePoint::max();
  for (const Client* one : clients_) first = std::min(first, one->urgent() ? now : one->due(now));
  return first;
}

void Bus::run() {
  constexpr ports::Duration kLongest = std::chrono::milliseconds(50);
  while (!ending_.load(std::memory_order_acquire)) {
    const ports::TimePoint now = clock_.now();
    if (step(now)) continue;
    const ports::Duration wait = std::clamp(next(now) - now, ports::Duration(1000000), kLongest);
    // Cleared only with the semaphore down: else a second wake would raise it twice.
    if (work_.try_acquire_for(wait)) awake_.store(false, std::memory_order_release);
  }
}

}  // namespace chiaro::drivers::modbus
