// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/daemon.h"

#include <CLI/CLI.hpp>
#include <ostream>

#include "controller/daemon/brain/brain.h"
#include "controller/panel/server/server.h"

namespace chiaro::daemon {
namespace {

constexpr ports::Duration kTurn = std::chrono::milliseconds(20);

struct Arguments {
  std::string studio;
  panel::ServerOptions server;
};

/// The built page: beside the installed config, else in the source tree.
std::filesystem::path web_folder(const std::filesystem::path& config) {
  const auto installed = config.parent_path() / "web";
  std::error_code code;
  if (std::filesystem::exists(installed / "index.html", code)) return installed;
  return config.parent_path() / "controller/panel/web/dist";
}

/// Nothing, or the exit that the arguments already decide.
std::optional<ports::Exit> parse(std::span<const std::string> words, ports::World& world,
                                 Arguments& arguments) {
  CLI::App app{"Chiaro's brain: designs looks, tells the output process, serves the panel.",
               "chiarod"};
  std::string web;
  app.add_option("STUDIO", arguments.studio, "the studio's YAML file")->required();
  app.add_option("--port", arguments.server.port, "port of panel and API")->capture_default_str();
  app.add_option("--listen", arguments.server.address, "address; beyond 127.0.0.1 give a --token")
      ->capture_default_str();
  app.add_option("--token", arguments.server.token, "what clients must send as bearer token");
  app.add_option("--web", web, "folder of the built page");
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // CLI11 wants it so
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, world.out, world.err) == 0 ? ports::Exit::done : ports::Exit::usage;
  }
  if (arguments.server.token.empty() && !panel::is_loopback(arguments.server.address)) {
    world.err << "chiarod: listening on " << arguments.server.address
              << " lets others reach the lights (give a --token of your choice as well)\n";
    return ports::Exit::usage;
  }
  arguments.server.web = web.empty() ? web_folder(world.config_folder) : std::filesystem::path(web);
  return std::nullopt;
}

void print(const core::Problems& problems, std::ostream& err) {
  for (const core::Problem& problem : problems)
    err << "chiarod: " << core::to_string(problem) << "\n";
}

/// One turn: world, hand, listeners.
void turn(ports::World& world, panel::Loop& loop, Brain& brain, panel::Server& server) {
  if (world.stop) return loop.stop();
  brain.count_traffic(server.requests(), server.listeners(), server.watchers());
  brain.tick(world.clock.now());
  for (const std::string& event : brain.events()) server.tell(event);
}

std::string address_for_people(const Arguments& arguments, std::uint16_t port) {
  const std::string& address = arguments.server.address;
  const std::string host = address == "0.0.0.0" || address == "::"  ? "127.0.0.1"
                           : address.find(':') != std::string::npos ? "[" + address + "]"
                                                                    : address;
  return "http://" + host + ":" + std::to_string(port) + "/";
}

}  // namespace

ports::Exit run_daemon(std::span<const std::string> words, ports::World& world) {
  Arguments arguments;
  if (const auto exit = parse(words, world, arguments)) return *exit;
  panel::Loop loop;
  auto brain = Brain::open(world, arguments.studio,
                           [&loop](std::function<void()> work) { loop.post(std::move(work)); });
  if (!brain) {
    print(brain.problems(), world.err);
    return ports::Exit::input_has_problems;
  }
  auto server = panel::Server::open(loop, arguments.server, **brain);
  if (!server) {
    print(server.problems(), world.err);
    return ports::Exit::out_of_reach;
  }
  print((*brain)->state().problems, world.err);
  (*brain)->watch_cameras([&](const std::string& camera, std::shared_ptr<const std::string> jpeg) {
    (*server)->show(camera, std::move(jpeg));
  });
  loop.every(kTurn, [&] { turn(world, loop, **brain, **server); });
  world.out << "panel: " << address_for_people(arguments, (*server)->port()) << std::endl;
  loop.run();
  return ports::Exit::done;
}

}  // namespace chiaro::daemon
