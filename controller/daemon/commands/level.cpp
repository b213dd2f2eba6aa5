// SPDX-License-Identifier: Apache-2.0
// `chiaro level LAMP PERCENT|release`: a fader at the hand itself, with or without a brain.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

std::string in_words(const nlohmann::json& answer) {
  std::ostringstream words;
  words << answer.value("fixture", "");
  if (answer.value("released", false))
    words << ": given back";
  else
    words << " at " << 100 * answer.value("level", 0.0) << " %";
  return words.str();
}

}  // namespace

void declare_level(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "level", "a lamp at a level until the next look, or given back; works without chiarod");
  auto lamp = std::make_shared<std::string>();
  auto level = std::make_shared<std::string>();
  verb->add_option("LAMP", *lamp, "the fixture's name, or * for every one")->required();
  verb->add_option("PERCENT", *level, "0 to 100 of its full light, or the word release")
      ->required()
      ->check(CLI::Range(0.0, 100.0) | CLI::IsMember({"release"}));
  verb->callback([&world, &verdict, lamp, level] {
    verdict.exit = ask_hand(world, verdict.json, "level " + *level + " " + *lamp, in_words);
  });
}

}  // namespace chiaro::daemon
