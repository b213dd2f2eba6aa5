// SPDX-License-Identifier: Apache-2.0
// `chiaro master NAME PERCENT`: a master fader at the hand itself, with or without a brain.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

std::string in_words(const nlohmann::json& answer) {
  std::ostringstream words;
  words << "The " << answer.value("master", "") << " master is at "
        << 100 * answer.value("level", 0.0) << " %.";
  return words.str();
}

}  // namespace

void declare_master(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "master", "the grand master or that of the key, fill, back or background lights");
  auto name = std::make_shared<std::string>();
  auto level = std::make_shared<std::string>();
  verb->add_option("NAME", *name, "grand, key, fill, back or background")
      ->required()
      ->check(CLI::IsMember({"grand", "key", "fill", "back", "background"}));
  verb->add_option("PERCENT", *level, "0 to 100; levels are multiplied by it")
      ->required()
      ->check(CLI::Range(0.0, 100.0));
  verb->callback([&world, &verdict, name, level] {
    verdict.exit = ask_hand(world, verdict.json, "master " + *name + " " + *level, in_words);
  });
}

}  // namespace chiaro::daemon
