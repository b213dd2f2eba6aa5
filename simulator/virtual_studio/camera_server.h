// SPDX-License-Identifier: Apache-2.0
// The virtual studio's cameras as IP cameras serve themselves: one picture, or a stream of them.
//
//   GET /camera/NAME          image/jpeg, taken after the request arrived
//   GET /camera/NAME/stream   multipart/x-mixed-replace: frames as they are taken
//   GET /status               JSON
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "controller/core/result.h"

namespace chiaro::simulator {

/// One I/O thread of its own; all methods are thread-safe. Pictures are made only while somebody
/// waits for one: `wanted` tells.
class CameraServer {
 public:
  struct Options {
    std::string address = "127.0.0.1";
    std::uint16_t port = 8091;  ///< 0 = any free one
    std::vector<std::string> cameras;
    std::function<std::string()> status;  ///< called on the I/O thread
    std::function<void()> on_wish;        ///< called on the I/O thread when somebody asks for more
  };
  /// A port in use, or one that needs rights, is a problem with its remedy.
  static core::Result<std::unique_ptr<CameraServer>> open(Options options);
  ~CameraServer();

  std::uint16_t port() const;
  /// A number that grows with every request, for each camera that somebody waits for now. Take it
  /// before the picture: only those who asked before are answered with it.
  struct Wish {
    std::size_t camera = 0;
    std::uint64_t asked = 0;
  };
  std::vector<Wish> wishes() const;
  void show(const Wish& wish, std::string jpeg);

  struct State;

 private:
  explicit CameraServer(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

}  // namespace chiaro::simulator
