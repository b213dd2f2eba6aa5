// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/control.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "controller/daemon/output/real_time.h"

namespace chiaro::daemon {
namespace {

constexpr std::size_t kMostClients = 16, kLongestLine = 512;

core::Problem trouble(const std::filesystem::path& socket, const std::string& doing) {
  return {{socket.string()},
          "cannot " + doing + ": " + std::strerror(errno),
          "CHIARO_RUNTIME names another folder",
          false};
}

}  // namespace

core::Result<std::unique_ptr<Control>> Control::open(const std::filesystem::path& socket,
                                                     const Answers& answers, bool real_time) {
  const std::string path = socket.string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    return core::Problem{{path},
                         "this path is too long for a socket (107 characters at most)",
                         "set CHIARO_RUNTIME to a shorter folder"};
  std::copy(path.begin(), path.end(), address.sun_path);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listener < 0) return trouble(socket, "make a socket");
  ::unlink(path.c_str());  // of a hand that was killed: we hold the lock, so none is alive
  if (::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::chmod(path.c_str(), 0660) != 0 || ::listen(listener, 8) != 0) {
    const auto problem = trouble(socket, "listen on the control socket");
    ::close(listener);
    return problem;
  }
  return std::unique_ptr<Control>(new Control(listener, socket, answers, real_time));
}

Control::Control(int listener, std::filesystem::path socket, const Answers& answers, bool real_time)
    : listener_(listener), socket_(std::move(socket)), answers_(answers) {
  if (::pipe2(wake_, O_CLOEXEC) != 0) wake_[0] = wake_[1] = -1;
  thread_ = std::thread([this, real_time] {
    if (real_time) take_turn_below_loop();
    serve();
  });
}

Control::~Control() {
  ending_ = true;
  answers_.end();
  const char byte = 0;
  if (::write(wake_[1], &byte, 1) < 0) {
    // Then the poll's own time-out ends the wait.
  }
  thread_.join();
  for (const Client& client : clients_) ::close(client.descriptor);
  ::close(listener_);
  ::close(wake_[0]);
  ::close(wake_[1]);
  ::unlink(socket_.c_str());
}

void Control::serve() {
  while (!ending_) {
    std::vector<pollfd> waits{{listener_, POLLIN, 0}, {wake_[0], POLLIN, 0}};
    for (const Client& client : clients_) waits.push_back({client.descriptor, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), 500) <= 0) continue;
    // From the back, so that removing one leaves the others' places.
    for (std::size_t i = clients_.size(); i-- > 0;) {
      if (waits[i + 2].revents == 0 || read_from(clients_[i])) continue;
      ::close(clients_[i].descriptor);
      clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (waits[0].revents != 0) accept_one();
  }
}

void Control::accept_one() {
  const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (descriptor < 0) return;
  if (clients_.size() >= kMostClients) {  // a forgotten client must not keep a blackout out
    ::close(clients_.front().descriptor);
    clients_.erase(clients_.begin());
  }
  clients_.push_back({descriptor, {}});
}

bool Control::read_from(Client& client) {
  std::array<char, 256> bytes;
  const auto got = ::read(client.descriptor, bytes.data(), bytes.size());
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  if (got == 0) return false;
  client.text.append(bytes.data(), static_cast<std::size_t>(got));
  for (auto end = client.text.find('\n'); end != std::string::npos; end = client.text.find('\n')) {
    const std::string reply = answers_.to(client.text.substr(0, end)) + "\n";
    client.text.erase(0, end + 1);
    if (::send(client.descriptor, reply.data(), reply.size(), MSG_NOSIGNAL) < 0) return false;
  }
  return client.text.size() <= kLongestLine;
}

}  // namespace chiaro::daemon
