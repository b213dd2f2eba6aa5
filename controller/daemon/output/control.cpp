// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/control.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "controller/daemon/output/answer_words.h"
#include "controller/daemon/output/real_time.h"

namespace chiaro::daemon {
namespace {

constexpr std::size_t kMostClients = 16, kMostRequests = 64, kLongestLine = 4400;

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
  worker_ = std::thread([this] { work(); });
}

Control::~Control() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  asked_.notify_all();
  answers_.end();
  const char byte = 0;
  if (::write(wake_[1], &byte, 1) < 0) {
    // Then the poll's own time-out ends the wait.
  }
  thread_.join();
  worker_.join();
  clients_.clear();
  ::close(listener_);
  ::close(wake_[0]);
  ::close(wake_[1]);
  ::unlink(socket_.c_str());
}

Control::Connection::~Connection() { ::close(descriptor); }

void Control::serve() {
  while (!ending_) {
    std::vector<pollfd> waits{{listener_, POLLIN, 0}, {wake_[0], POLLIN, 0}};
    for (const Client& client : clients_)
      waits.push_back({client.connection->descriptor, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), 500) <= 0) continue;
    // From the back, so that removing one leaves the others' places.
    for (std::size_t i = clients_.size(); i-- > 0;) {
      if (waits[i + 2].revents == 0 || read_from(clients_[i])) continue;
      clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (waits[0].revents != 0) accept_one();
  }
}

void Control::accept_one() {
  const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (descriptor < 0) return;
  if (clients_.size() >= kMostClients)  // a forgotten client must not keep a blackout out
    clients_.erase(clients_.begin());
  clients_.push_back({std::make_shared<Connection>(descriptor), {}});
}

bool Control::read_from(Client& client) {
  std::array<char, 256> bytes;
  const auto got = ::read(client.connection->descriptor, bytes.data(), bytes.size());
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  if (got == 0) return false;
  client.text.append(bytes.data(), static_cast<std::size_t>(got));
  for (auto end = client.text.find('\n'); end != std::string::npos; end = client.text.find('\n')) {
    take({client.connection, client.text.substr(0, end)});
    client.text.erase(0, end + 1);
  }
  return client.text.size() <= kLongestLine;
}

/// A blackout waits for nobody: the loop takes it with its next frame.
void Control::take(Request request) {
  if (request.line == "blackout on" || request.line == "blackout off") return answer(request);
  {
    const std::scoped_lock lock(mutex_);
    if (requests_.size() < kMostRequests) {
      requests_.push_back(std::move(request));
      asked_.notify_one();
      return;
    }
  }
  send(*request.connection, refusal("too much is being asked at once", "ask again in a moment"));
}

void Control::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    asked_.wait(lock, [this] { return ending_ || !requests_.empty(); });
    if (ending_) return;
    const Request request = std::move(requests_.front());
    requests_.pop_front();
    lock.unlock();
    answer(request);
    lock.lock();
  }
}

/// Whatever goes wrong with an answer, the output goes on.
void Control::answer(const Request& request) {
  std::string reply;
  try {
    reply = answers_.to(request.line);
  } catch (const std::exception& fault) {
    reply = refusal(std::string("internal fault: ") + fault.what(),
                    "this is a bug in Chiaro: please report it with the request");
  }
  send(*request.connection, reply);
}

void Control::send(const Connection& connection, const std::string& reply) const {
  const std::string line = reply + "\n";
  for (std::size_t done = 0; done < line.size() && !ending_;) {
    const auto sent =
        ::send(connection.descriptor, line.data() + done, line.size() - done, MSG_NOSIGNAL);
    if (sent > 0) {
      done += static_cast<std::size_t>(sent);
      continue;
    }
    pollfd room{connection.descriptor, POLLOUT, 0};  // who does not read is given up
    if (sent == 0 || errno != EAGAIN || ::poll(&room, 1, 200) <= 0) return;
  }
}

}  // namespace chiaro::daemon
