// SPDX-License-Identifier: Apache-2.0
// `chiaro mark KIND LAMP [--off]`: finds a lamp, shows it alone, parks it; straight to the hand.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

struct Asked {
  std::string kind, lamp;
  bool off = false;
};

std::string in_words(const nlohmann::json& answer) {
  if (answer.contains("marks")) return "No lamp is marked here any more.";
  return answer.value("fixture", "") + ": " + answer.value("mark", "") +
         (answer.value("on", false) ? " on" : " off");
}

ports::Exit mark(ports::World& world, bool json, const Asked& asked) {
  if (asked.kind == "none") return ask_hand(world, json, "marks off", in_words);
  const std::string lamp = asked.lamp.empty() ? "*" : asked.lamp;
  return ask_hand(world, json, "mark " + asked.kind + (asked.off ? " off " : " on ") + lamp,
                  in_words);
}

}  // namespace

void declare_mark(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "mark",
      "a lamp highlighted, flashed, shown alone, parked or moved in black; without chiarod");
  auto asked = std::make_shared<Asked>();
  verb->add_option("KIND", asked->kind,
                   "highlight: full and white, to find it; flash: full for a moment; solo: the "
                   "others dark; park: stays as it is; move-in-black; none: takes all marks away")
      ->required()
      ->check(CLI::IsMember({"highlight", "flash", "solo", "park", "move-in-black", "none"}));
  verb->add_option("LAMP", asked->lamp, "the fixture's name; without one: every lamp");
  verb->add_flag("--off", asked->off, "takes the mark away");
  verb->callback([&world, &verdict, asked] { verdict.exit = mark(world, verdict.json, *asked); });
}

}  // namespace chiaro::daemon
