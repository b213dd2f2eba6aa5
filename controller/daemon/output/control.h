// SPDX-License-Identifier: Apache-2.0
// The hand's own Unix socket, so that blackout works with the brain dead. One line in, one line of
// JSON out (answers.h). A blackout is taken at once, whatever else is being asked: everything that
// may take its time has a thread of its own behind this one.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "controller/core/result.h"
#include "controller/daemon/output/answers.h"

namespace chiaro::daemon {

/// Serves on threads of its own from construction to destruction.
class Control {
 public:
  /// `real_time`: ask for a real-time turn, so that a blackout comes through a busy machine.
  static core::Result<std::unique_ptr<Control>> open(const std::filesystem::path& socket,
                                                     const Answers& answers, bool real_time);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

 private:
  struct Connection {
    explicit Connection(int number) : descriptor(number) {}
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    const int descriptor;
  };
  struct Client {
    std::shared_ptr<Connection> connection;  ///< and of its requests that are under way
    std::string text;
  };
  struct Request {
    std::shared_ptr<Connection> connection;
    std::string line;
  };
  Control(int listener, std::filesystem::path socket, const Answers& answers, bool real_time);
  void serve();
  void accept_one();
  bool read_from(Client& client);
  void take(Request request);
  void work();
  void answer(const Request& request);
  void send(const Connection& connection, const std::string& reply) const;

  const int listener_;
  const std::filesystem::path socket_;
  Answers answers_;
  std::vector<Client> clients_;
  std::atomic<bool> ending_{false};
  int wake_[2] = {-1, -1};
  std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<Request> requests_;  ///< all but blackouts; under the mutex
  std::thread thread_, worker_;
};

}  // namespace chiaro::daemon
