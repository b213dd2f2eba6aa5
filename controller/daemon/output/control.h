// SPDX-License-Identifier: Apache-2.0
// The hand's own Unix socket, so that blackout works with the brain dead. One line in, one line of
// JSON out (answers.h).
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/output/answers.h"

namespace chiaro::daemon {

/// Serves on a thread of its own from construction to destruction.
class Control {
 public:
  /// `real_time`: ask for a real-time turn, so that a blackout comes through a busy machine.
  static core::Result<std::unique_ptr<Control>> open(const std::filesystem::path& socket,
                                                     const Answers& answers, bool real_time);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

 private:
  struct Client {
    int descriptor;
    std::string text;
  };
  Control(int listener, std::filesystem::path socket, const Answers& answers, bool real_time);
  void serve();
  void accept_one();
  bool read_from(Client& client);

  const int listener_;
  const std::filesystem::path socket_;
  Answers answers_;
  std::vector<Client> clients_;
  std::atomic<bool> ending_{false};
  int wake_[2] = {-1, -1};
  std::thread thread_;
};

}  // namespace chiaro::daemon
