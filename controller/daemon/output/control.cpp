// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/control.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "controller/daemon/output/real_time.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostClients = 16, kLongestLine = 256;

core::Problem trouble(const std::filesystem::path& socket, const std::string& doing) {
  return {{socket.string()},
          "cannot " + doing + ": " + std::strerror(errno),
          "CHIARO_RUNTIME names another folder",
          false};
}

std::string refusal(const core::Problems& problems) {
  Json list = Json::array();
  for (const auto& p : problems)
    list.push_back({{"file", p.where.file},
                    {"line", p.where.line},
                    {"column", p.where.column},
                    {"what", p.what},
                    {"remedy", p.remedy}});
  return Json{{"problems", list}}.dump();
}

std::string refusal(const std::string& what, const std::string& remedy) {
  return refusal(core::Problems{{{}, what, remedy, false}});
}

std::string_view name_of(ports::PortHealth health) {
  switch (health) {
    case ports::PortHealth::closed:
      return "closed";
    case ports::PortHealth::good:
      return "good";
    case ports::PortHealth::lost:
      return "lost";
  }
  return "?";
}

}  // namespace

core::Result<std::unique_ptr<Control>> Control::open(const std::filesystem::path& socket,
                                                     Hand& hand, Housekeeper& housekeeper,
                                                     std::atomic<bool>& release, bool real_time) {
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
  return std::unique_ptr<Control>(
      new Control(listener, socket, hand, housekeeper, release, real_time));
}

Control::Control(int listener, std::filesystem::path socket, Hand& hand, Housekeeper& housekeeper,
                 std::atomic<bool>& release, bool real_time)
    : listener_(listener),
      socket_(std::move(socket)),
      hand_(hand),
      housekeeper_(housekeeper),
      release_(release) {
  if (::pipe2(wake_, O_CLOEXEC) != 0) wake_[0] = wake_[1] = -1;
  thread_ = std::thread([this, real_time] {
    if (real_time) take_turn_below_loop();
    serve();
  });
}

Control::~Control() {
  ending_ = true;
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
    const std::string reply = answer(client.text.substr(0, end)) + "\n";
    client.text.erase(0, end + 1);
    if (::send(client.descriptor, reply.data(), reply.size(), MSG_NOSIGNAL) < 0) return false;
  }
  return client.text.size() <= kLongestLine;
}

std::string Control::answer(const std::string& line) {
  if (line == "blackout on") return blackout(true);
  if (line == "blackout off") return blackout(false);
  if (line == "status") return status();
  if (line == "reload") {
    const auto outcome = housekeeper_.reload_now(std::chrono::seconds(8));
    return outcome ? Json{{"reload", true}}.dump() : refusal(outcome.problems());
  }
  if (line == "release") {
    release_ = true;
    return Json{{"release", true}}.dump();
  }
  return refusal("unknown request '" + line.substr(0, 40) + "'",
                 "known: blackout on, blackout off, status, reload, release");
}

std::string Control::blackout(bool on) {
  const std::uint64_t wish = hand_.wish_blackout(on);
  // The loop takes it at its next frame, 25 ms away at most; it never waits for us, so we look.
  for (int i = 0; i < 1000 && !ending_; ++i) {
    if (hand_.taken(wish)) return Json{{"blackout", on}}.dump();
    ::poll(nullptr, 0, 1);
  }
  return refusal("the output loop did not take the blackout within a second",
                 "switch the lamps' mains off if they must go dark now");
}

std::string Control::status() const {
  const rig::Sent sent = housekeeper_.newest_report();
  Json json{{"caution", rig::name_of(sent.caution)},
            {"blackout", sent.blackout},
            {"refused", sent.refused},
            {"real_time", sent.real_time},
            {"dry_run", sent.dry_run},
            {"ports", Json::array()}};
  for (const auto& port : sent.ports)
    json["ports"].push_back({{"universe", port.universe},
                             {"health", name_of(static_cast<ports::PortHealth>(port.health))},
                             {"rate_hz", port.rate_hz},
                             {"frames", port.frames},
                             {"failed", port.failed},
                             {"late", port.late},
                             {"missed", port.missed},
                             {"jitter_us",
                              {{"p50", port.jitter_us_p50},
                               {"p99", port.jitter_us_p99},
                               {"p99.9", port.jitter_us_p999}}}});
  return json.dump();
}

}  // namespace chiaro::daemon
