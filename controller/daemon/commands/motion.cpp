// SPDX-License-Identifier: Apache-2.0
// `chiaro motion stop|release|arm|disarm`: straight to the hand, like the blackout.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

std::string in_words(const nlohmann::json& answer) {
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
  verb->add_option("stop|release|arm|disarm", *wish,
                   "stop: every axis freezes, the light stays; release: ends the stop, moves "
                   "nothing; arm: motors may move; disarm: they may not")
      ->required()
      ->check(CLI::IsMember({"stop", "release", "arm", "disarm"}));
  verb->callback([&world, &verdict, wish] {
    verdict.exit = ask_hand(world, verdict.json, "motion " + *wish, in_words);
  });
}

}  // namespace chiaro::daemon
