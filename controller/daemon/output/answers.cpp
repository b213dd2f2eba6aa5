// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/answers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <poll.h>
#include <sstream>

#include "controller/daemon/output/cue_book.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;
using rig::Mark;

constexpr std::array kMarks{Mark::highlight, Mark::flash, Mark::solo, Mark::park,
                            Mark::move_in_black};
constexpr double kLongestTime = 24 * 3600;

std::string refusal(const core::Problems& problems) {
  Json list = Json::array();
  for (const auto& p : problems)
    list.push_back({{"file", p.where.file},
                    {"line", p.where.line},
                    {"column", p.where.column},
                    {"what", p.what},
                    {"remedy", p.remedy}});
  return Json{{"problems", list}}.dump();
}

std::string refusal(const std::string& what, const std::string& remedy) {
  return refusal(core::Problems{{{}, what, remedy, false}});
}

std::string not_in_time() {
  return refusal("the output loop did not act within a second",
                 "look at `chiaro-output`'s messages");
}

/// Takes the first word off `words`.
std::string first_of(std::string& words) {
  const auto end = std::min(words.find(' '), words.size());
  std::string word = words.substr(0, end);
  words.erase(0, std::min(end + 1, words.size()));
  return word;
}

std::optional<double> number_in(const std::string& word) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(value) || value < 0)
    return std::nullopt;
  return value;
}

std::optional<Mark> mark_named(const std::string& word) {
  for (const Mark mark : kMarks)
    if (word == rig::name_of(mark)) return mark;
  return std::nullopt;
}

std::string_view name_of(ports::PortHealth health) {
  switch (health) {
    case ports::PortHealth::closed:
      return "closed";
    case ports::PortHealth::good:
      return "good";
    case ports::PortHealth::lost:
      return "lost";
  }
  return "?";
}

Json port_json(const rig::Sent::Port& port) {
  return {
      {"universe", port.universe},
      {"health", name_of(static_cast<ports::PortHealth>(port.health))},
      {"rate_hz", port.rate_hz},
      {"frames", port.frames},
      {"failed", port.failed},
      {"late", port.late},
      {"missed", port.missed},
      {"jitter_us",
       {{"p50", port.jitter_us_p50}, {"p99", port.jitter_us_p99}, {"p99.9", port.jitter_us_p999}}}};
}

Json lamp_json(const std::string& name, rig::Marks marks, rig::Limited limited) {
  Json json{{"fixture", name}, {"marks", Json::array()}, {"limited_by", Json::array()}};
  for (const Mark mark : kMarks)
    if (rig::has(marks, mark)) json["marks"].push_back(rig::name_of(mark));
  for (unsigned bit = 1; bit < 256; bit <<= 1u)
    if ((limited & bit) != 0)
      json["limited_by"].push_back(rig::name_of(static_cast<rig::Limit>(bit)));
  return json;
}

}  // namespace

template <class Condition>
bool Answers::wait(Condition condition) const {
  // The loop never waits for us, so we look.
  for (int i = 0; i < 1000 && !ending_; ++i) {
    if (condition()) return true;
    ::poll(nullptr, 0, 1);
  }
  return false;
}

bool Answers::done(const Wish& wish) {
  const std::uint64_t number = hand_.wish(wish);
  return number != 0 && wait([&] { return hand_.obeyed(number); }) &&
         wait([&] { return housekeeper_.newest_report().sent_ns >= hand_.obeyed_at_ns(); });
}

std::string Answers::to(const std::string& line) {
  std::string rest = line;
  const std::string verb = first_of(rest);
  if (line == "blackout on") return blackout(true);
  if (line == "blackout off") return blackout(false);
  if (line == "status") return status();
  if (line == "marks off") return unmark();
  if (line == "reload") {
    const auto outcome = housekeeper_.reload_now(std::chrono::seconds(8));
    return outcome ? Json{{"reload", true}}.dump() : refusal(outcome.problems());
  }
  if (line == "release") {
    release_ = true;
    return Json{{"release", true}}.dump();
  }
  if (verb == "motion") return motion(rest);
  if (verb == "mark") return mark(rest);
  if (verb == "cue") return cue(rest);
  return refusal("unknown request '" + line.substr(0, 40) + "'",
                 "known: blackout, motion, mark, marks, cue, status, reload, release");
}

std::string Answers::blackout(bool on) {
  const std::uint64_t wish = hand_.wish_blackout(on);
  if (wait([&] { return hand_.taken(wish); })) return Json{{"blackout", on}}.dump();
  return refusal("the output loop did not take the blackout within a second",
                 "switch the lamps' mains off if they must go dark now");
}

std::string Answers::motion(const std::string& word) {
  Wish wish;
  wish.kind =
      word == "stop" || word == "release" ? Wish::Kind::motion_stop : Wish::Kind::motion_arm;
  wish.on = word == "stop" || word == "arm";
  if (!wish.on && word != "release" && word != "disarm")
    return refusal("unknown motion request '" + word + "'", "known: stop, release, arm, disarm");
  if (!done(wish))
    return refusal("the output loop did not act within a second",
                   "cut the motors' power if they must stand still now");
  const rig::Sent sent = housekeeper_.newest_report();
  if (word == "arm" && sent.motion_stop.on)
    return refusal("motion is stopped, so it cannot be armed", "`chiaro motion release` first");
  return Json{{"stopped", sent.motion_stop.on},
              {"armed", sent.motion_armed.on},
              {"axes_waiting", sent.axes_waiting}}
      .dump();
}

std::string Answers::mark(const std::string& words) {
  std::string lamp = words;
  const auto kind = mark_named(first_of(lamp));
  const std::string on = first_of(lamp);
  if (!kind || (on != "on" && on != "off") || lamp.empty())
    return refusal("unknown mark '" + words.substr(0, 60) + "'",
                   "mark highlight|flash|solo|park|move-in-black on|off LAMP");
  const studio::Studio studio = housekeeper_.studio_now();
  Wish wish{Wish::Kind::mark, on == "on", *kind, 0, studio.fingerprint, 0};
  std::vector<std::string> names;
  bool found = false;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    names.push_back(studio.fixtures[i].name);
    if (lamp != "*" && lamp != names.back()) continue;
    found = true;
    wish.fixture = static_cast<std::uint32_t>(i);
    if (!done(wish)) return not_in_time();
  }
  const std::string near = core::nearest_name(lamp, names);
  if (!found)
    return refusal("there is no lamp '" + lamp + "' in this studio",
                   near.empty() ? "`chiaro check` lists them" : "did you mean '" + near + "'?");
  return Json{{"mark", rig::name_of(*kind)}, {"on", wish.on}, {"fixture", lamp}}.dump();
}

std::string Answers::unmark() {
  const studio::Studio studio = housekeeper_.studio_now();
  const rig::Sent sent = housekeeper_.newest_report();
  for (std::size_t i = 0; i < sent.own_marks.size(); ++i)
    for (const Mark mark : kMarks)
      if (rig::has(sent.own_marks[i], mark) &&
          !done({Wish::Kind::mark, false, mark, static_cast<std::uint32_t>(i), studio.fingerprint,
                 0}))
        return not_in_time();
  return Json{{"marks", false}}.dump();
}

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
      "unknown cue request '" + words.substr(0, 60) + "'",
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
  return json.dump();
}

std::string Answers::cue_moves(Wish::Kind kind, double number) {
  const auto before = housekeeper_.newest_report().cue;
  if (before.cues == 0 && kind != Wish::Kind::cue_off)
    return refusal("there is no cue yet", "`chiaro cue record 1` keeps what is on stage now");
  if (!done({kind, true, Mark::highlight, 0, 0, number})) return not_in_time();
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
  return Json{{"cues", cues}}.dump();
}

std::string Answers::record(double number, const std::string& words) {
  rig::Cue cue;
  cue.number = number;
  cue.state.fade_s = 3;
  std::string rest = words;
  while (!rest.empty()) {
    const std::string key = first_of(rest);
    if (key == "name") {
      cue.name = std::exchange(rest, "").substr(0, 80);
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
  hand_.offer_cues(std::move(list));
  std::unique_ptr<rig::CueList> old;
  if (!wait([&] { return (old = hand_.collect_cues()) != nullptr; })) return not_in_time();
  return cue_list();
}

std::string Answers::status() const {
  const rig::Sent sent = housekeeper_.newest_report();
  const studio::Studio studio = housekeeper_.studio_now();
  Json json{{"caution", rig::name_of(sent.caution)},
            {"blackout", sent.blackout},
            {"blind", sent.blind},
            {"motion",
             {{"stopped", sent.motion_stop.on},
              {"armed", sent.motion_armed.on},
              {"axes_waiting", sent.axes_waiting}}},
            {"refused", sent.refused},
            {"real_time", sent.real_time},
            {"dry_run", sent.dry_run},
            {"cue", Json::parse(cue_now(sent))},
            {"lamps", Json::array()},
            {"circuits", Json::array()},
            {"ports", Json::array()}};
  for (std::size_t i = 0; i < studio.fixtures.size() && i < sent.marks.size(); ++i)
    if (sent.marks[i] != 0 || sent.limited[i] != 0)
      json["lamps"].push_back(lamp_json(studio.fixtures[i].name, sent.marks[i], sent.limited[i]));
  for (std::size_t i = 0; i < studio.circuits.size() && i < sent.circuits.size(); ++i)
    json["circuits"].push_back({{"name", studio.circuits[i].name},
                                {"limit_w", studio.circuits[i].limit_w},
                                {"draw_w", sent.circuits[i].draw_w},
                                {"scale", sent.circuits[i].scale}});
  for (const auto& port : sent.ports) json["ports"].push_back(port_json(port));
  return json.dump();
}

}  // namespace chiaro::daemon
