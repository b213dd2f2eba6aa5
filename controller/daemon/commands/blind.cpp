// SPDX-License-Identifier: Apache-2.0
// `chiaro blind on|off`: looks are prepared while the lamps stay as they are.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

std::string in_words(const nlohmann::json& answer) {
  return answer.value("blind", false)
             ? "Blind: looks and the panel's faders are prepared, and not sent until `chiaro blind "
               "off`. Masters, cues and blackout work as ever."
             : "Not blind: what was prepared fades in now.";
}

}  // namespace

void declare_blind(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("blind", "looks are prepared and not sent until it is off");
  auto on = std::make_shared<std::string>();
  verb->add_option("on|off", *on)->required()->check(CLI::IsMember({"on", "off"}));
  verb->callback([&world, &verdict, on] {
    verdict.exit = ask_hand(world, verdict.json, "blind " + *on, in_words);
  });
}

}  // namespace chiaro::daemon
