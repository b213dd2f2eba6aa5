// SPDX-License-Identifier: Apache-2.0
// Straight to the hand: this must work when the brain does not.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/hand_link.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

ports::Exit blackout(ports::World& world, bool on, bool json) {
  const auto done = hand_blackout(world.runtime_folder, on);
  if (done) {
    if (json)
      world.out << Json{{"blackout", on}} << "\n";
    else
      world.err << (on ? "Dark. It stays dark until `chiaro blackout off`.\n" : "Released.\n");
    return ports::Exit::done;
  }
  world.err << core::to_string(done.problems());
  if (json) {
    const auto& problem = done.problems().front();
    world.out << Json{{"error",
                       {{"what", problem.what},
                        {"where", core::to_string(problem.where)},
                        {"remedy", problem.remedy}}}}
              << "\n";
  }
  return ports::Exit::out_of_reach;
}

}  // namespace

void declare_blackout(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("blackout", "all lamps dark, or released; works without chiarod");
  auto wish = std::make_shared<std::string>();
  verb->add_option("on|off", *wish, "on: dark until released; off: back to the levels")
      ->required()
      ->check(CLI::IsMember({"on", "off"}));
  verb->callback(
      [&world, &verdict, wish] { verdict.exit = blackout(world, *wish == "on", verdict.json); });
}

}  // namespace chiaro::daemon
