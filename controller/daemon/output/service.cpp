// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/service.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace chiaro::daemon {

Service::Service() {
  const char* name = std::getenv("NOTIFY_SOCKET");
  if (name == nullptr) return;
  const std::string_view path(name);
  sockaddr_un address{};
  if (path.empty() || path.size() >= sizeof address.sun_path) return;
  address.sun_family = AF_UNIX;
  std::copy(path.begin(), path.end(), address.sun_path);
  if (path.front() == '@') address.sun_path[0] = '\0';  // an abstract socket
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0) return;
  ::close(socket_);
  socket_ = -1;
}

Service::~Service() {
  if (socket_ < 0) return;
  tell("STOPPING=1");
  ::close(socket_);
}

void Service::tell(const std::string& text) {
  if (::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) < 0) {
    // The manager is not listening; the work goes on all the same.
  }
}

void Service::alive(std::uint64_t work) {
  if (socket_ < 0 || work == last_) return;
  last_ = work;
  tell(ready_ ? "WATCHDOG=1" : "READY=1");
  ready_ = true;
}

}  // namespace chiaro::daemon
