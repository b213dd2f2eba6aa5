// SPDX-License-Identifier: Apache-2.0
// `chiaro cue …`: the hand's own cue stack, which plays on without a brain.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/daemon/hand_verb.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

struct Asked {
  std::string verb, number, name;
  double fade = 3, follow = -1;
};

std::string line_of(const Json& cue) {
  std::ostringstream line;
  line << (cue.value("playing", false) ? "> " : "  ") << cue.value("number", 0.0) << "  fade "
       << cue.value("fade_s", 0.0) << " s";
  if (cue["follow_s"].is_number()) line << ", follow " << cue["follow_s"].get<double>() << " s";
  if (const auto name = cue.value("name", ""); !name.empty()) line << "  " << name;
  return line.str();
}

std::string in_words(const Json& answer) {
  if (answer["cues"].is_array()) {
    if (answer["cues"].empty()) return "No cues yet: `chiaro cue record 1` keeps what is on stage.";
    std::string words;
    for (const Json& cue : answer["cues"]) words += (words.empty() ? "" : "\n") + line_of(cue);
    return words;
  }
  if (!answer["playing"].is_number()) return "No cue is on stage.";
  std::ostringstream words;
  words << "Cue " << answer["playing"].get<double>();
  if (const auto name = answer.value("name", ""); !name.empty()) words << " (" << name << ")";
  if (answer["follow_s"].is_number())
    words << "; the next follows in " << answer["follow_s"].get<double>() << " s";
  return words.str();
}

std::string line_to_hand(const Asked& asked) {
  std::string line = "cue " + asked.verb;
  if (!asked.number.empty()) line += " " + asked.number;
  if (asked.verb != "record") return line;
  std::ostringstream settings;
  settings << " fade " << asked.fade;
  if (asked.follow >= 0) settings << " follow " << asked.follow;
  if (!asked.name.empty()) settings << " name " << asked.name;
  return line + settings.str();
}

}  // namespace

void declare_cue(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand(
      "cue", "a small cue stack: record what is on stage, go, back, list; without chiarod");
  auto asked = std::make_shared<Asked>();
  verb->add_option("go|back|off|list|to|record|remove", asked->verb,
                   "go: the next; back: the one before; off: none; to, record, remove: NUMBER")
      ->required()
      ->check(CLI::IsMember({"go", "back", "off", "list", "to", "record", "remove"}));
  verb->add_option("NUMBER", asked->number, "of the cue; 2.5 comes between 2 and 3")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--fade", asked->fade, "record: seconds of its crossfade")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  verb->add_option("--follow", asked->follow, "record: seconds until the next goes by itself")
      ->check(CLI::Range(0.0, 3600.0));
  verb->add_option("--name", asked->name, "record: what people call it");
  verb->callback([&world, &verdict, asked] {
    const bool numbered = asked->verb == "to" || asked->verb == "record" || asked->verb == "remove";
    if (numbered == asked->number.empty())
      throw CLI::ValidationError("NUMBER", numbered ? "cue " + asked->verb + " needs a number"
                                                    : "cue " + asked->verb + " takes no number");
    verdict.exit = ask_hand(world, verdict.json, line_to_hand(*asked), in_words);
  });
}

}  // namespace chiaro::daemon
