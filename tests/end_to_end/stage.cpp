// SPDX-License-Identifier: Apache-2.0
#include "tests/end_to_end/stage.h"

#include <arpa/inet.h>
#include <fstream>
#include <netinet/in.h>
#include <sstream>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/common/http_client.h"

namespace chiaro::end_to_end {
namespace {

namespace fs = std::filesystem;

std::uint16_t free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(socket);
  return ntohs(address.sin_port);
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << "the shipped studio has no '" << from << "'";
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

EndToEnd::EndToEnd()
    : panel_port_(free_port()),
      camera_port_(free_port()),
      // Far from what anybody uses, and another one for each process that runs tests.
      universe_(static_cast<std::uint16_t>(20000 + ::getpid() % 40000)),
      environment_{{"CHIARO_STATE", (folder_.path() / "state").string()},
                   {"CHIARO_RUNTIME", (folder_.path() / "run").string()},
                   {"CHIARO_CONFIG", CHIARO_SOURCE "/config"}} {}

fs::path EndToEnd::write_studio(const std::vector<std::pair<std::string, std::string>>& changes) {
  auto text = content_of(CHIARO_SOURCE "/config/studios/portrait.yaml");
  const auto number = std::to_string(universe_);
  replace_all(text, "universe: 1,", "universe: " + number + ",");
  replace_all(text, "universe 1:", "universe " + number + ":");
  replace_all(text, ":8091/", ":" + std::to_string(camera_port_) + "/");
  for (const auto& [from, to] : changes) replace_all(text, from, to);
  const auto file = folder_.path() / "studio.yaml";
  std::ofstream(file) << text;
  return file;
}

std::string EndToEnd::asset(const std::string& path) {
  const auto file = fs::path(CHIARO_SOURCE "/build/assets") / path;
  EXPECT_TRUE(fs::exists(file)) << "fetch it with: tests/support/fetch_assets.sh build/assets";
  return file.string();
}

std::string EndToEnd::program(const std::string& name) {
  return (fs::path(CHIARO_BIN) / name).string();
}

Finished EndToEnd::chiaro(std::vector<std::string> words) {
  words.insert(words.begin(), program("chiaro"));
  return run(words, environment_, folder_.path());
}

std::unique_ptr<Process> EndToEnd::demo(const fs::path& studio, std::vector<std::string> words) {
  const std::vector<std::string> first{program("chiaro"), "demo",   "--studio",
                                       studio.string(),   "--port", std::to_string(panel_port_),
                                       "--stand-time",    "0.2"};
  words.insert(words.begin(), first.begin(), first.end());
  return std::make_unique<Process>(words, environment_, folder_.path(), "demo");
}

std::unique_ptr<Process> EndToEnd::receiver() {
  const std::string script = CHIARO_SOURCE "/tests/peers/sacn_receiver.mjs";
  EXPECT_TRUE(fs::exists(CHIARO_SOURCE "/tests/peers/node_modules/sacn"))
      << "install it with: npm --prefix tests/peers ci";
  auto process = std::make_unique<Process>(
      std::vector<std::string>{"node", script, std::to_string(universe_), "127.0.0.1"},
      environment_, folder_.path(), "receiver");
  EXPECT_TRUE(eventually([&] { return process->out().find("listening") != std::string::npos; }))
      << process->err();
  return process;
}

std::vector<Json> EndToEnd::packets(const Process& receiver) {
  std::vector<Json> result;
  std::istringstream lines(receiver.out());
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    auto json = Json::parse(line, nullptr, false);
    if (json.is_object() && (json.contains("sequence") || json.contains("problem")))
      result.push_back(std::move(json));
  }
  return result;
}

Json EndToEnd::ask(const std::string& method, const std::string& path, const Json& body) {
  drivers::HttpRequest request;
  request.method = method;
  request.url = "http://127.0.0.1:" + std::to_string(panel_port_) + path;
  if (!body.is_null()) request.body = body.dump();
  const auto reply = drivers::http_request(request, std::chrono::seconds(10));
  if (!reply || reply->status >= 300) return nullptr;
  auto json = Json::parse(reply->body, nullptr, false);
  return json.is_discarded() ? Json(nullptr) : json;
}

}  // namespace chiaro::end_to_end
