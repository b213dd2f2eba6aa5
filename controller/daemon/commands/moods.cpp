// SPDX-License-Identifier: Apache-2.0
// `chiaro moods [WORDS]`: the moods there are, best match first, and why.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/command.h"
#include "controller/daemon/json_text.h"
#include "controller/daemon/problems.h"
#include "controller/design/vocabulary.h"
#include "controller/design/words.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::ordered_json;

/// Below this a mood has little to do with what was asked.
constexpr double kWorthShowing = 0.25;

struct Found {
  std::vector<design::Mood> moods;
  std::vector<design::Qualities> qualities;
  design::MoodSearch search;
  bool asked = false;
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Json json_of(const design::Mood& mood, const design::Qualities& q, const design::MoodMatch& match) {
  Json tags = Json::object();
  for (std::size_t k = 0; k < core::mood_tag_kinds().size(); ++k)
    tags[core::mood_tag_kinds()[k].name] = mood.tags.at(k);
  return {{"name", mood.name},
          {"title", mood.title},
          {"sentence", mood.sentence},
          {"score", match.score},
          {"because", match.because},
          {"tags", tags},
          {"words", mood.words},
          {"attainable", mood.attainable},
          {"sitter_turn_deg", core::degrees(mood.sitter_turn)},
          {"white_balance_k", mood.white_balance ? Json(mood.white_balance->value) : Json()},
          {"exposure_stops", mood.exposure_stops ? Json(*mood.exposure_stops) : Json()},
          {"qualities",
           {{"lightness", q.lightness},
            {"contrast", q.contrast},
            {"darkness", q.darkness},
            {"warmth", q.warmth},
            {"hardness", q.hardness}}}};
}

void print_json(const Found& found, std::ostream& out) {
  Json moods = Json::array();
  for (const design::MoodMatch& match : found.search.matches)
    moods.push_back(json_of(found.moods[match.mood], found.qualities[match.mood], match));
  out << json_text(Json{{"moods", moods}, {"unknown", found.search.unknown}}) << "\n";
}

void print_text(const Found& found, std::ostream& out) {
  for (const design::MoodMatch& match : found.search.matches) {
    if (found.asked && match.score < kWorthShowing) continue;
    const design::Mood& mood = found.moods[match.mood];
    out << mood.name;
    if (found.asked) out << ", fits by " << design::number(100 * match.score, 0) << " %";
    out << "\n  " << mood.sentence << "\n  " << joined(mood.tags.words());
    if (const std::string turn = design::turn_in_words(mood.sitter_turn); !turn.empty())
      out << "; turn the sitter " << turn;
    if (!mood.attainable) out << "; more than the shipped studio can do";
    if (!match.because.empty()) out << "\n  because: " << joined(match.because);
    out << "\n";
  }
}

ports::Exit run(const std::vector<std::string>& words, ports::World& world, bool json) {
  const studio::Folders folders{world.config_folder};
  design::Moods loaded = design::load_moods(folders.moods());
  Found found;
  found.moods = std::move(loaded.moods);
  found.qualities = design::qualities_of(found.moods, loaded.problems);
  std::string text;
  for (const std::string& word : words) text += word + " ";
  found.asked = !words.empty();
  found.search = design::search_moods(found.moods, found.qualities, text);
  if (found.moods.empty() && loaded.problems.empty())
    loaded.problems.push_back({{folders.moods().string()},
                               "there are no moods here",
                               "put pictures there, each in a folder with a mood.yaml"});
  if (found.moods.empty()) return refuse(loaded.problems, world, json);
  for (const core::Problem& problem : loaded.problems)
    world.err << core::to_string(problem) << "\n";
  for (const std::string& word : found.search.unknown)
    world.err << "no mood and no word of light: " << word << "\n";
  if (json)
    print_json(found, world.out);
  else
    print_text(found, world.out);
  return ports::Exit::done;
}

}  // namespace

void declare_moods(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("moods", "the moods there are; with words, best match first");
  auto words = std::make_shared<std::vector<std::string>>();
  verb->add_option("WORDS", *words, "what the light should be, as in: dark warm calm");
  verb->callback([words, &world, &verdict] { verdict.exit = run(*words, world, verdict.json); });
}

}  // namespace chiaro::daemon
