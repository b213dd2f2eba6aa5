// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/api.h"

#include <charconv>
#include <sstream>

#include "controller/panel/json.h"

namespace chiaro::panel {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& path) {
  Words words;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '/');) words.push_back(word);
  return words;
}

Response json_answer(std::string body, int status = 200) {
  return {status, "application/json", std::move(body), {{"Cache-Control", "no-store"}}};
}

std::string looks_to_json(const std::vector<LookEntry>& looks) {
  Json list = Json::array();
  for (const LookEntry& look : looks) {
    const std::string base = "/api/v1/looks/" + std::to_string(look.id);
    list.push_back({{"id", look.id},
                    {"name", look.name},
                    {"mood", look.mood},
                    {"verdict", look.verdict},
                    {"created", look.created},
                    {"live", look.live},
                    {"kept", look.kept},
                    {"picture", base + "/picture"}});
  }
  return Json({{"looks", list}}).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<PictureOf> picture_of(const Words& words) {
  if (words.size() != 3) return std::nullopt;
  using Kind = PictureOf::Kind;
  if (words[2] == "picture" && words[0] == "moods") return PictureOf{Kind::mood, words[1], 0};
  if (words[2] == "picture" && words[0] == "cameras") return PictureOf{Kind::camera, words[1], 0};
  if (words[0] != "looks") return std::nullopt;
  std::int64_t id = 0;
  const auto [end, code] = std::from_chars(words[1].data(), words[1].data() + words[1].size(), id);
  if (code != std::errc() || end != words[1].data() + words[1].size()) id = -1;
  if (words[2] == "picture") return PictureOf{Kind::look_wanted, words[1], id};
  if (words[2] == "placed_picture") return PictureOf{Kind::look_placed, words[1], id};
  if (words[2] == "reference") return PictureOf{Kind::look_reference, words[1], id};
  return std::nullopt;
}

Response picture_answer(const PictureOf& which, Brain& brain) {
  auto picture = brain.picture(which);
  if (const auto* refusal = std::get_if<Refusal>(&picture)) return refuse(*refusal);
  auto& file = std::get<PictureFile>(picture);
  return {200, file.type, std::move(file.bytes), {{"Cache-Control", "no-store"}}};
}

/// The addresses that only answer, and those of routes.def.
std::string addresses_to_json() {
  static constexpr std::pair<const char*, const char*> kAsked[] = {
      {"state", "all that can be seen of the studio"},
      {"moods", "shipped and own pictures"},
      {"moods/*/picture", "the picture of a mood"},
      {"looks", "looks that were found or saved"},
      {"looks/*/picture", "the look as predicted, lamps where they are wanted"},
      {"looks/*/placed_picture", "the same, lamps where they stand"},
      {"looks/*/reference", "the picture that it was to be like"},
      {"design/*", "how a job stands"},
      {"outputs/*/slots", "what is in the 512 slots of a universe now"},
      {"cameras/*/picture", "the camera's newest picture"},
      {"cameras/*/stream", "its pictures, one after another (MJPEG)"},
      {"events", "WebSocket: state and design events"}};
  Json list = Json::array();
  for (const auto& [path, what] : kAsked)
    list.push_back({{"method", "GET"}, {"path", "/api/v1/" + std::string(path)}, {"what", what}});
  for (const Address& address : addresses())
    list.push_back({{"method", address.method},
                    {"path", "/api/v1/" + std::string(address.path)},
                    {"what", address.what},
                    {"example", address.example}});
  return Json({{"addresses", list}}).dump();
}

Response get(const Request& request, const Words& words, Brain& brain) {
  if (words.empty()) return json_answer(addresses_to_json());
  if (words.size() == 3 && words[0] == "outputs" && words[2] == "slots")
    for (const OutputView& output : brain.state().outputs)
      if (std::to_string(output.universe) == words[1])
        return json_answer(slots_to_json(brain.state(), output));
  if (words == Words{"state"}) return json_answer(state_to_json(brain.state()));
  if (words == Words{"moods"}) return json_answer(moods_to_json(brain.state()));
  if (words == Words{"looks"}) return json_answer(looks_to_json(brain.looks()));
  if (const auto which = picture_of(words)) return picture_answer(*which, brain);
  if (words.size() == 2 && words[0] == "design" && brain.state().design &&
      std::to_string(brain.state().design->job) == words[1])
    return json_answer(job_to_json(*brain.state().design));
  // What a gesture would answer to this address is the better refusal: 405 where it exists.
  return refuse(std::get<Refusal>(gesture_of(request, words, brain.state())));
}

Response answer_of(const Outcome& outcome) {
  return outcome.refused ? refuse(*outcome.refused) : json_answer(outcome.json, outcome.status);
}

}  // namespace

void answer(const Request& request, Brain& brain, Reply reply) {
  if (request.path == "/metrics" && request.method == "GET")
    return reply({200,
                  "text/plain; version=0.0.4; charset=utf-8",
                  metrics_of(brain.state(), brain.counters()),
                  {}});
  Words words = words_of(request.path);
  if (words.size() < 3 || words[1] != "api" || words[2] != "v1")
    return reply(refuse({404, "there is nothing at " + request.path, request.path,
                         "the API begins at /api/v1/state"}));
  words.erase(words.begin(), words.begin() + 3);
  if (words == Words{"session"} && request.method == "POST")
    return reply({204, "", "", {}});  // let in already; the server adds the cookie
  if (request.method == "GET") return reply(get(request, words, brain));
  auto made = gesture_of(request, words, brain.state());
  if (const auto* refusal = std::get_if<Refusal>(&made)) return reply(refuse(*refusal));
  brain.perform(std::get<Gesture>(made),
                [reply](const Outcome& outcome) { reply(answer_of(outcome)); });
}

}  // namespace chiaro::panel
