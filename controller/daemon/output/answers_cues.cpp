// SPDX-License-Identifier: Apache-2.0
// What is asked of the cue stack.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "controller/daemon/output/answer_words.h"
#include "controller/daemon/output/answers.h"
#include "controller/daemon/output/cue_book.h"
#include "controller/daemon/output/state_json.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;
constexpr double kLongestTime = 24 * 3600;

}  // namespace

std::string Answers::cue(const std::string& words) {
  std::string rest = words;
  const std::string verb = first_of(rest);
  if (words == "go") return cue_moves(Wish::Kind::cue_go, 0);
  if (words == "back") return cue_moves(Wish::Kind::cue_back, 0);
  if (words == "off") return cue_moves(Wish::Kind::cue_off, 0);
  if (words == "list") return cue_list();
  const auto number = number_in(first_of(rest));
  if (number && verb == "to" && rest.empty()) return cue_moves(Wish::Kind::cue_to, *number);
  if (number && verb == "remove" && rest.empty()) return remove(*number);
  if (number && verb == "record") return record(*number, rest);
  return refusal(
      "unknown cue request '" + cut(words, 60) + "'",
      "known: go, back, off, list, to N, remove N, record N [fade S] [follow S] [name …]");
}

std::string Answers::cue_now(const rig::Sent& sent) const {
  core::Problems ignored;
  const auto list = read_cues(state_folder_, housekeeper_.studio_now(), ignored);
  Json json{{"playing", nullptr}, {"cues", sent.cue.cues}, {"follow_s", nullptr}};
  if (sent.cue.follow_s >= 0) json["follow_s"] = sent.cue.follow_s;
  if (sent.cue.playing >= 0) json["playing"] = sent.cue.number;
  for (const rig::Cue& cue : list->cues)
    if (sent.cue.playing >= 0 && cue.number == sent.cue.number) json["name"] = cue.name;
  return text_of(json);
}

std::string Answers::cue_moves(Wish::Kind kind, double number) {
  const auto before = housekeeper_.newest_report().cue;
  if (before.cues == 0 && kind != Wish::Kind::cue_off)
    return refusal("there is no cue yet", "`chiaro cue record 1` keeps what is on stage now");
  Wish wish;
  wish.kind = kind;
  wish.number = number;
  if (!done(wish)) return not_in_time();
  const rig::Sent sent = housekeeper_.newest_report();
  const bool moved = sent.cue.playing != before.playing;
  if (kind == Wish::Kind::cue_go && !moved)
    return refusal("cue " + number_in_words(before.number) + " is the last one",
                   "`chiaro cue to 1`, or `chiaro cue back`");
  if (kind == Wish::Kind::cue_back && !moved)
    return refusal(before.playing < 0 ? "no cue is on stage" : "this is the first cue",
                   "`chiaro cue go`");
  if (kind == Wish::Kind::cue_to && sent.cue.number != number)
    return refusal("there is no cue " + number_in_words(number), "`chiaro cue list` shows them");
  return cue_now(sent);
}

std::string Answers::cue_list() const {
  core::Problems warnings;
  const auto list = read_cues(state_folder_, housekeeper_.studio_now(), warnings);
  if (!warnings.empty()) return refusal(warnings);
  const rig::Sent sent = housekeeper_.newest_report();
  Json cues = Json::array();
  for (const rig::Cue& cue : list->cues) {
    Json json{{"number", cue.number}, {"name", cue.name}, {"fade_s", cue.state.fade_s}};
    json["follow_s"] = cue.follow_s ? Json(*cue.follow_s) : Json();
    json["playing"] = sent.cue.playing >= 0 && sent.cue.number == cue.number;
    cues.push_back(json);
  }
  return text_of(Json{{"cues", cues}});
}

std::string Answers::record(double number, const std::string& words) {
  rig::Cue cue;
  cue.number = number;
  cue.state.fade_s = 3;
  std::string rest = words;
  while (!rest.empty()) {
    const std::string key = first_of(rest);
    if (key == "name") {
      cue.name = cut(std::exchange(rest, ""), 80);
      break;
    }
    const auto seconds = number_in(first_of(rest));
    if ((key != "fade" && key != "follow") || !seconds || *seconds > kLongestTime)
      return refusal("unknown cue setting '" + key + "'", "fade S, follow S, name WORDS");
    if (key == "fade")
      cue.state.fade_s = *seconds;
    else
      cue.follow_s = *seconds;
  }
  cue.state.fixtures = housekeeper_.newest_report().held;
  core::Problems warnings;
  auto list = read_cues(state_folder_, housekeeper_.studio_now(), warnings);
  if (!warnings.empty()) return refusal(warnings);  // never write over what a person may mend
  list->put(std::move(cue));
  return keep(std::move(list));
}

std::string Answers::remove(double number) {
  core::Problems warnings;
  auto list = read_cues(state_folder_, housekeeper_.studio_now(), warnings);
  if (!list->remove(number))
    return refusal("there is no cue " + number_in_words(number), "`chiaro cue list` shows them");
  return keep(std::move(list));
}

/// On the disk first, then to the loop: what was answered for is there after a power cut.
std::string Answers::keep(std::unique_ptr<rig::CueList> list) {
  const auto written = write_cues(state_folder_, housekeeper_.studio_now(), *list);
  if (!written) return refusal(written.problems());
  list->look_ahead();
  const rig::CueList* const offered = list.get();
  hand_.offer_cues(std::move(list));
  std::unique_ptr<rig::CueList> old;
  if (!wait([&] { return (old = hand_.collect_cues()) != nullptr; })) return not_in_time();
  if (old.get() == offered)
    return refusal("the studio file has just been read again", "it is kept; ask once more");
  return cue_list();
}

}  // namespace chiaro::daemon
