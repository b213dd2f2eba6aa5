// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/one_look.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "controller/core/colour.h"
#include "controller/core/picture_file.h"
#include "drivers/common/http_client.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr double kDesignPatience_s = 180, kLightPatience_s = 180;
constexpr double kSettled_s = 0.6;  ///< nothing has changed for so long: slower than any lamp's lag

core::Problem refused(const drivers::HttpReply& reply) {
  const auto json = Json::parse(reply.body, nullptr, false);
  if (json.is_object() && json.contains("error") && json["error"].is_object())
    return {{}, json["error"].value("what", ""), json["error"].value("remedy", "")};
  return {{}, "the daemon answered with status " + std::to_string(reply.status), ""};
}

core::Result<drivers::HttpReply> ask(const DemoLink& link, const std::string& method,
                                     const std::string& path, const std::string& body = "") {
  drivers::HttpRequest request;
  request.method = method;
  request.url = link.daemon + path;
  request.body = body;
  auto reply = drivers::http_request(request, 10s);
  if (reply && reply->status >= 300) return refused(*reply);
  return reply;
}

core::Result<Json> ask_json(const DemoLink& link, const std::string& method,
                            const std::string& path, const std::string& body = "") {
  const auto reply = ask(link, method, path, body);
  if (!reply) return reply.problems();
  auto json = Json::parse(reply->body, nullptr, false);
  if (json.is_discarded()) return core::Problem{{}, path + " did not answer with JSON", ""};
  return json;
}

core::Result<core::EncodedPicture> ask_picture(const DemoLink& link, const std::string& path) {
  const auto reply = ask(link, "GET", path);
  if (!reply) return reply.problems();
  const std::vector<std::uint8_t> bytes(reply->body.begin(), reply->body.end());
  return core::decode_picture(bytes, path);
}

/// Asks for the state again and again until `done` says so. A daemon that does not answer for a
/// moment (it may be starting again) is asked again; the patience is the limit.
core::Result<Json> wait_for_state(const DemoLink& link, double patience_s, const std::string& what,
                                  const std::function<bool(const Json&)>& done) {
  const double start = link.seconds();
  std::string last = "it did not answer";
  while (link.seconds() - start < patience_s) {
    const auto state = ask_json(link, "GET", "/api/v1/state");
    if (state && done(*state)) return *state;
    if (!state)
      last = state.problems().front().what;
    else
      last = state->value("/studio/stage"_json_pointer, "");
    if (auto go_on = link.wait(); !go_on) return go_on.problems();
  }
  return core::Problem{{},
                       fmt::format("{} did not happen within {:.0f} s ({})", what, patience_s,
                                   last.empty() ? "no reason given" : last),
                       "look into the logs; a very slow machine may need another try"};
}

/// The job's end: its look, or why there is none.
core::Result<std::int64_t> wait_for_design(const DemoLink& link, std::uint64_t job,
                                           std::ostream& progress) {
  std::string said;
  const auto state = wait_for_state(link, kDesignPatience_s, "the design", [&](const Json& now) {
    const auto& design = now["design"];
    if (!design.is_object() || design.value("job", 0u) != job) return false;
    const auto words = fmt::format("designing: {} {}/{}", design.value("stage", ""),
                                   design.value("trial", 0u), design.value("trials", 0u));
    if (words != said) progress << words << "\n" << std::flush;
    said = words;
    const auto status = design.value("status", "");
    return status == "done" || status == "failed" || status == "cancelled";
  });
  if (!state) return state.problems();
  const auto& design = (*state)["design"];
  if (design.value("status", "") == "done") return design["look"].get<std::int64_t>();
  const auto error =
      design.contains("error") && design["error"].is_object() ? design["error"] : Json::object();
  return core::Problem{{},
                       "the design failed: " + error.value("what", "no reason given"),
                       error.value("remedy", "")};
}

/// What must stand still before the camera's picture counts.
std::string light_of(const Json& state) {
  std::string all;
  for (const auto& fixture : state["fixtures"]) all += fixture["sent"].dump();
  return all;
}

core::Result<Json> wait_for_light(const DemoLink& link, std::int64_t look, std::ostream& progress) {
  std::string light;
  std::size_t waiting = 0;
  double since = link.seconds();
  return wait_for_state(link, kLightPatience_s, "the light", [&](const Json& now) {
    const auto left = now["instructions"].size();
    if (left > 0 && left != waiting)
      for (const auto& one : now["instructions"])
        progress << "stagehand: " << one.value("words", "") << "\n" << std::flush;
    waiting = left;
    const auto& live = now["look"];
    const bool there = live.is_object() && live.value("id", std::int64_t{0}) == look &&
                       live.value("fade", 0.0) >= 1 && left == 0;
    if (const auto seen = light_of(now); !there || seen != light) {
      light = seen;
      since = link.seconds();
      return false;
    }
    return link.seconds() - since >= kSettled_s;
  });
}

std::string lamp_in_words(const Json& fixture) {
  std::string text = fixture.value("name", "") + ": ";
  for (const auto* part : {"words", "level", "colour"})
    if (const auto words = fixture.value(part, ""); !words.empty())
      text += (text.back() == ' ' ? "" : " · ") + words;
  return text;
}

/// Mean difference in lightness, the camera's picture brought to the preview's size.
double difference(const core::EncodedPicture& preview, const core::EncodedPicture& camera) {
  const auto a = core::luminance(core::linear(preview));
  const auto b = core::luminance(core::resized(core::linear(camera), preview.size));
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::abs(core::lightness(a.values[i]) - core::lightness(b.values[i]));
  return a.values.empty() ? 0 : sum / static_cast<double>(a.values.size());
}

core::Result<core::Done> take_pictures(const DemoLink& link, const Json& state, MadeLook& made) {
  struct Wanted {
    std::string path;
    core::EncodedPicture& into;
  };
  const auto& look = state["look"];
  for (const auto& [path, into] :
       {Wanted{look.value("reference", ""), made.reference},
        Wanted{look.value("picture", ""), made.preview},
        Wanted{state["cameras"].empty() ? "" : state["cameras"][0].value("picture", ""),
               made.camera}}) {
    if (path.empty()) return core::Problem{{}, "the daemon names no picture", ""};
    auto picture = ask_picture(link, path);
    if (!picture) return picture.problems();
    into = std::move(*picture);
  }
  made.difference = difference(made.preview, made.camera);
  return core::Done{};
}

}  // namespace

core::Result<core::Done> wait_until_ready(const DemoLink& link, double patience_s) {
  const auto state = wait_for_state(link, patience_s, "the start", [](const Json& now) {
    return now["studio"].value("ready", false) && now["hand"].value("connected", false);
  });
  if (!state) return state.problems();
  return core::Done{};
}

core::Result<MadeLook> make_look(const DemoLink& link, const std::string& mood, double fade_s,
                                 std::ostream& progress) {
  const double start = link.seconds();
  const auto job =
      ask_json(link, "POST", "/api/v1/design", Json{{"mood", mood}, {"seed", 1}}.dump());
  if (!job) return job.problems();
  const auto look = wait_for_design(link, job->value("job", std::uint64_t{0}), progress);
  if (!look) return look.problems();
  const auto applied = ask(link, "POST", fmt::format("/api/v1/looks/{}/apply", *look),
                           Json{{"fade_s", fade_s}}.dump());
  if (!applied) return applied.problems();
  const auto state = wait_for_light(link, *look, progress);
  if (!state) return state.problems();
  const auto& live = (*state)["look"];
  MadeLook made;
  made.until_light_s = link.seconds() - start;
  made.mood = mood;
  made.title = live.value("name", mood);
  made.verdict = live.value("verdict", "");
  made.remedy = live.value("remedy", "");
  made.ratio = live.value("ratio", "");
  made.trials = live.value("trials", std::uint64_t{0});
  made.design_s = live.value("seconds", 0.0);
  for (const auto& fixture : (*state)["fixtures"]) made.lamps.push_back(lamp_in_words(fixture));
  if (const auto taken = take_pictures(link, *state, made); !taken) return taken.problems();
  return made;
}

core::EncodedPicture side_by_side(const MadeLook& look) {
  constexpr int kGap = 8;
  const core::EncodedPicture* const all[] = {&look.reference, &look.preview, &look.camera};
  const int height = look.camera.size.height;
  std::vector<core::EncodedPicture> scaled;
  int width = 2 * kGap;
  for (const auto* picture : all) {
    const int w = std::max(1, picture->size.width * height / std::max(1, picture->size.height));
    scaled.push_back(core::encoded(core::resized(core::linear(*picture), {w, height})));
    width += w;
  }
  core::EncodedPicture result({width, height}, {255, 255, 255});
  int left = 0;
  for (const auto& picture : scaled) {
    for (int y = 0; y < height; ++y)
      std::copy_n(picture.row(y), picture.size.width, result.row(y) + left);
    left += picture.size.width + kGap;
  }
  return result;
}

std::string in_words(const MadeLook& look, const std::filesystem::path& picture) {
  std::string text = fmt::format("{}: {}", look.title, look.verdict);
  if (!look.ratio.empty()) text += fmt::format(", key to fill {}", look.ratio);
  text += "\n";
  if (!look.remedy.empty()) text += "  " + look.remedy + "\n";
  for (const auto& lamp : look.lamps) text += "  " + lamp + "\n";
  text += fmt::format(
      "  found in {:.2f} s and {} trials; light and stands in place after {:.1f} s\n"
      "  the camera's picture is {:.1f} L* from the preview on average\n"
      "  reference, preview and camera side by side: {}\n",
      look.design_s, look.trials, look.until_light_s, look.difference, picture.string());
  return text;
}

std::string in_json(const MadeLook& look, const std::filesystem::path& picture) {
  const Json json = {{"mood", look.mood},
                     {"verdict", look.verdict},
                     {"remedy", look.remedy},
                     {"ratio", look.ratio},
                     {"lamps", look.lamps},
                     {"trials", look.trials},
                     {"design_s", look.design_s},
                     {"until_light_s", look.until_light_s},
                     {"camera_from_preview_lightness", look.difference},
                     {"picture", picture.string()}};
  return json.dump() + "\n";
}

}  // namespace chiaro::daemon
