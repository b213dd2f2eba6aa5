// SPDX-License-Identifier: Apache-2.0
// What drivers reach the world through, and what ports of one program share with each other.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "controller/ports/clock.h"
#include "controller/ports/devices.h"
#include "controller/ports/network.h"

namespace chiaro::drivers {

/// Things that several ports use together because there can be one only: Art-Net's UDP port with
/// its table of nodes, a Modbus line. Each lives as long as somebody uses it. Thread-safe.
class Shared {
 public:
  /// The one of that kind and name, made now if nobody has it.
  template <class T, class Make>
  std::shared_ptr<T> get(const std::string& name, Make make) {
    const std::scoped_lock lock(mutex_);
    std::weak_ptr<void>& slot = things_[std::string(T::kKind) + " " + name];
    if (auto living = std::static_pointer_cast<T>(slot.lock())) return living;
    std::shared_ptr<T> fresh = make();
    slot = fresh;
    return fresh;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<void>> things_;
};

/// One per program; outlives every port made with it.
struct Surroundings {
  ports::Network& network;
  ports::Devices& devices;
  ports::Clock& clock;
  Shared shared{};
  /// False in tests: what would have a thread of its own is moved by those who use it.
  bool threads = true;
};

}  // namespace chiaro::drivers
