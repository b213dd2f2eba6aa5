// SPDX-License-Identifier: Apache-2.0
// The service manager's side of a program: systemd's notification protocol, which is one datagram
// to the socket that $NOTIFY_SOCKET names. Without one all of this does nothing.
#pragma once

#include <cstdint>
#include <string>

namespace chiaro::daemon {

/// Says READY once and then WATCHDOG as long as the work goes on. One thread.
class Service {
 public:
  Service();
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  /// `work`: a counter that moves while the loop lives; the watchdog is fed only when it moved.
  void alive(std::uint64_t work);

 private:
  void tell(const std::string& text);
  int socket_ = -1;
  bool ready_ = false;
  std::uint64_t last_ = 0;
};

}  // namespace chiaro::daemon
