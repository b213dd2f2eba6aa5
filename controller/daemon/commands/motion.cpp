// SPDX-License-Identifier: Apache-2.0
// `chiaro motion stop|release|arm|disarm` and `chiaro motion home LAMP`: straight to the hand, like
// the blackout.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

std::string in_words(const nlohmann::json& answer) {
  if (answer.contains("home"))
    return "The motor of " + answer.value("home", "") + " looks for its home.";
  const auto waiting = answer.value("axes_waiting", 0);
  std::string words = answer.value("stopped", false)
                          ? "Motion is stopped. The light stays; `chiaro motion release`, then "
                            "`chiaro motion arm`, lets motors move again."
                      : answer.value("armed", false) ? "Motion is armed: motors may move."
                                                     : "Motion is not armed: no motor moves.";
  if (waiting > 0) words += " Axes that wait to move: " + std::to_string(waiting) + ".";
  return words;
}

}  // namespace

void declare_motion(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb =
      app.add_subcommand("motion", "motors stopped, released, armed or disarmed; without chiarod");
  auto wish = std::make_shared<std::string>();
  verb->add_option("stop|release|arm|disarm|home", *wish,
                   "stop: every axis freezes, the light stays; release: ends the stop, moves "
                   "nothing; arm: motors may move; disarm: they may not; home: a motor finds its "
                   "zero")
      ->required()
      ->check(CLI::IsMember({"stop", "release", "arm", "disarm", "home"}));
  auto lamp = std::make_shared<std::string>();
  verb->add_option("LAMP", *lamp, "whose motor is homed");
  verb->callback([&world, &verdict, wish, lamp] {
    if ((*wish == "home") == lamp->empty())
      throw CLI::ValidationError(lamp->empty() ? "home needs a LAMP: `chiaro motion home key`"
                                               : "only home takes a LAMP");
    const std::string line = "motion " + *wish + (lamp->empty() ? "" : " " + *lamp);
    verdict.exit = ask_hand(world, verdict.json, line, in_words);
  });
}

}  // namespace chiaro::daemon
