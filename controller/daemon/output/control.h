// SPDX-License-Identifier: Apache-2.0
// The hand's own Unix socket, so that blackout works with the brain dead. One line in, one line of
// JSON out: `blackout on|off`, `status`, `reload`, `release`.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/output/hand.h"
#include "controller/daemon/output/housekeeper.h"

namespace chiaro::daemon {

/// Serves on a thread of its own from construction to destruction.
class Control {
 public:
  /// `release` is set when somebody asks the hand to say goodbye and end. `real_time`: ask for a
  /// real-time turn, so that a blackout comes through a busy machine.
  static core::Result<std::unique_ptr<Control>> open(const std::filesystem::path& socket,
                                                     Hand& hand, Housekeeper& housekeeper,
                                                     std::atomic<bool>& release, bool real_time);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

 private:
  struct Client {
    int descriptor;
    std::string text;
  };
  Control(int listener, std::filesystem::path socket, Hand& hand, Housekeeper& housekeeper,
          std::atomic<bool>& release, bool real_time);
  void serve();
  void accept_one();
  bool read_from(Client& client);
  std::string answer(const std::string& line);
  std::string blackout(bool on);
  std::string status() const;

  const int listener_;
  const std::filesystem::path socket_;
  Hand& hand_;
  Housekeeper& housekeeper_;
  std::atomic<bool>& release_;
  std::vector<Client> clients_;
  std::atomic<bool> ending_{false};
  int wake_[2] = {-1, -1};
  std::thread thread_;
};

}  // namespace chiaro::daemon
