// SPDX-License-Identifier: Apache-2.0
// HTTP, WebSocket and MJPEG over the API, and the page's files. Thread-bound: the loop.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "controller/core/result.h"
#include "controller/panel/api.h"
#include "controller/panel/server/loop.h"

namespace chiaro::panel {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8090;          ///< 0 = any free one
  std::string token;                  ///< must be set when `address` is beyond loopback
  std::filesystem::path web;          ///< the built page; may be absent: a note is served instead
  std::size_t most_body = 24u << 20;  ///< bytes; beyond: 413
  std::size_t most_connections = 200;
};

class Server {
 public:
  /// Binds and listens. Problems: the address is not one, is in use (with what to do), or goes
  /// beyond loopback without a token. `loop` and `brain` must outlive the server.
  static core::Result<std::unique_ptr<Server>> open(Loop& loop, const ServerOptions& options,
                                                    Brain& brain);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;
  /// Sends one JSON message to every open event stream. A listener that cannot keep up is closed:
  /// it comes back and is told the whole state.
  void tell(const std::string& json);
  /// The newest picture of a camera, as JPEG, to everyone who watches it. Slow watchers skip.
  void show(const std::string& camera, std::shared_ptr<const std::string> jpeg);
  std::size_t listeners() const;
  /// Who watches a camera's stream now.
  std::size_t watchers() const;
  std::uint64_t requests() const;

  struct State;

 private:
  explicit Server(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// True for 127.x.x.x, ::1 and "localhost"; false for what is no address.
bool is_loopback(const std::string& address);

/// The message that tells a listener everything.
std::string state_event(const panel::State& state);

}  // namespace chiaro::panel
