// SPDX-License-Identifier: Apache-2.0
// The client's side of the hand's control socket: one line there, one line of JSON back.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "controller/daemon/hand_link.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

core::Problem not_running(const std::filesystem::path& socket) {
  return {{socket.string()},
          "chiaro-output is not running, so nothing is sent to the lamps from here",
          "start it with `chiaro-output STUDIO`; CHIARO_RUNTIME must be the same for both",
          false};
}

core::Problem no_answer(const std::filesystem::path& socket) {
  return {{socket.string()},
          "chiaro-output did not answer in time",
          "look at its messages; if lamps must go dark now, switch their mains off",
          false};
}

core::Result<std::string> read_line(int descriptor, const std::filesystem::path& socket,
                                    ports::Duration patience) {
  std::string text;
  std::array<char, 4096> bytes;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (text.find('\n') == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    pollfd wait{descriptor, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&wait, 1, static_cast<int>(left.count())) <= 0)
      return no_answer(socket);
    const auto got = ::read(descriptor, bytes.data(), bytes.size());
    if (got <= 0) return no_answer(socket);
    text.append(bytes.data(), static_cast<std::size_t>(got));
  }
  return text.substr(0, text.find('\n'));
}

core::Problems problems_in(const Json& answer) {
  core::Problems problems;
  for (const Json& p : answer.value("problems", Json::array()))
    problems.push_back({{p.value("file", ""), p.value("line", 0), p.value("column", 0)},
                        p.value("what", ""),
                        p.value("remedy", ""),
                        false});
  if (problems.empty()) problems.push_back({{}, "chiaro-output refused", "", false});
  return problems;
}

core::Result<std::string> call(const std::filesystem::path& runtime_folder, const std::string& line,
                               ports::Duration patience) {
  const auto socket = runtime_folder / "output.sock";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = socket.string();
  if (path.size() >= sizeof address.sun_path)
    return core::Problem{{path},
                         "this path is too long for a socket (107 characters at most)",
                         "set CHIARO_RUNTIME to a shorter folder"};
  std::copy(path.begin(), path.end(), address.sun_path);
  const Descriptor descriptor{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  if (::connect(descriptor.number, reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
      0)
    return not_running(socket);
  const std::string request = line + "\n";
  if (::send(descriptor.number, request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    return not_running(socket);
  auto answer = read_line(descriptor.number, socket, patience);
  if (!answer) return answer;
  const Json json = Json::parse(*answer, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return no_answer(socket);
  if (json.contains("problems")) return problems_in(json);
  return answer;
}

core::Result<core::Done> done(const core::Result<std::string>& answer) {
  if (!answer) return answer.problems();
  return core::Done{};
}

}  // namespace

core::Result<core::Done> hand_blackout(const std::filesystem::path& runtime_folder, bool on,
                                       ports::Duration patience) {
  return done(call(runtime_folder, on ? "blackout on" : "blackout off", patience));
}

core::Result<core::Done> hand_reload(const std::filesystem::path& runtime_folder,
                                     ports::Duration patience) {
  return done(call(runtime_folder, "reload", patience));
}

core::Result<std::string> hand_request(const std::filesystem::path& runtime_folder,
                                       const std::string& line, ports::Duration patience) {
  return call(runtime_folder, line, patience);
}

core::Result<std::string> hand_status(const std::filesystem::path& runtime_folder,
                                      ports::Duration patience) {
  return call(runtime_folder, "status", patience);
}

}  // namespace chiaro::daemon
