// SPDX-License-Identifier: Apache-2.0
// What is asked of single lamps and of the masters: marks, levels, blind.
#include <nlohmann/json.hpp>
#include <optional>

#include "controller/daemon/output/answer_words.h"
#include "controller/daemon/output/answers.h"
#include "controller/daemon/output/state_json.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;
using rig::Mark;

std::optional<Mark> mark_named(const std::string& word) {
  for (const Mark mark : kMarks)
    if (word == rig::name_of(mark)) return mark;
  return std::nullopt;
}

std::optional<rig::Master> master_named(const std::string& word) {
  for (std::size_t m = 0; m < rig::kMasters; ++m)
    if (word == rig::name_of(static_cast<rig::Master>(m))) return static_cast<rig::Master>(m);
  return std::nullopt;
}

}  // namespace

/// One wish for the lamp of that name, or for each with `*`. Empty when the loop has obeyed.
std::string Answers::wish_for(const std::string& lamp, Wish wish) {
  const studio::Studio studio = housekeeper_.studio_now();
  wish.studio = studio.fingerprint;
  const auto index = studio.fixture_index(lamp);
  if (index || lamp == "*") {
    wish.fixture = index ? static_cast<std::uint32_t>(*index) : Wish::kEvery;
    return done(wish) ? "" : not_in_time();
  }
  std::vector<std::string> names;
  for (const auto& fixture : studio.fixtures) names.push_back(fixture.name);
  const std::string near = core::nearest_name(lamp, names);
  return refusal("there is no lamp '" + lamp + "' in this studio",
                 near.empty() ? "`chiaro check` lists them" : "did you mean '" + near + "'?");
}

std::string Answers::mark(const std::string& words) {
  std::string lamp = words;
  const auto kind = mark_named(first_of(lamp));
  const std::string on = first_of(lamp);
  if (!kind || (on != "on" && on != "off") || lamp.empty())
    return refusal("unknown mark '" + cut(words, 60) + "'",
                   "mark highlight|flash|solo|park|move-in-black on|off LAMP");
  Wish wish;
  wish.kind = Wish::Kind::mark;
  wish.mark = *kind;
  wish.on = on == "on";
  if (const std::string refused = wish_for(lamp, wish); !refused.empty()) return refused;
  return text_of(Json{{"mark", rig::name_of(*kind)}, {"on", wish.on}, {"fixture", lamp}});
}

std::string Answers::unmark() {
  for (const Mark mark : kMarks) {
    Wish wish;
    wish.kind = Wish::Kind::mark;
    wish.mark = mark;
    if (const std::string refused = wish_for("*", wish); !refused.empty()) return refused;
  }
  return text_of(Json{{"marks", false}});
}

std::string Answers::level(const std::string& words) {
  std::string lamp = words;
  const std::string value = first_of(lamp);
  const auto percent = number_in(value);
  const bool release = value == "release";
  if (lamp.empty() || (!release && (!percent || *percent > 100)))
    return refusal("unknown level '" + cut(words, 60) + "'",
                   "level PERCENT LAMP, 0 to 100, or level release LAMP");
  Wish wish;
  wish.kind = release ? Wish::Kind::release : Wish::Kind::level;
  if (!release) wish.number = *percent / 100;
  if (const std::string refused = wish_for(lamp, wish); !refused.empty()) return refused;
  Json json{{"fixture", lamp}, {"released", release}};
  if (!release) json["level"] = wish.number;
  return text_of(json);
}

std::string Answers::master(const std::string& words) {
  std::string rest = words;
  const auto which = master_named(first_of(rest));
  const auto percent = number_in(rest);
  if (!which || !percent || *percent > 100)
    return refusal("unknown master '" + cut(words, 60) + "'",
                   "master grand|key|fill|back|background PERCENT, 0 to 100");
  Wish wish;
  wish.kind = Wish::Kind::master;
  wish.master = *which;
  wish.number = *percent / 100;
  if (!done(wish)) return not_in_time();
  return text_of(Json{{"master", rig::name_of(*which)}, {"level", wish.number}});
}

std::string Answers::blind(bool on) {
  Wish wish;
  wish.kind = Wish::Kind::blind;
  wish.on = on;
  if (!done(wish)) return not_in_time();
  return text_of(Json{{"blind", on}});
}

}  // namespace chiaro::daemon
