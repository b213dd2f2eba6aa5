// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/one_look.h"

#include <algorithm>
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

void tell_design(Teller& tell, const Json& design, std::string& said) {
  const auto stage = design.value("stage", "");
  if (tell.terminal)
    tell.out << fmt::format("\r\033[Kdesigning: {} {}/{}", stage, design.value("trial", 0u),
                            design.value("trials", 0u))
             << std::flush;
  else if (stage != said && !stage.empty())
    tell.out << "designing: " << stage << "\n" << std::flush;
  said = stage;
}

/// The job's end: its look, or why there is none.
core::Result<std::int64_t> wait_for_design(const DemoLink& link, std::uint64_t job, Teller tell) {
  std::string said;
  const auto state = wait_for_state(link, kDesignPatience_s, "the design", [&](const Json& now) {
    const auto& design = now["design"];
    if (!design.is_object() || design.value("job", 0u) != job) return false;
    tell_design(tell, design, said);
    const auto status = design.value("status", "");
    return status == "done" || status == "failed" || status == "cancelled";
  });
  if (tell.terminal) tell.out << "\r\033[K" << std::flush;
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

void tell_stands(Teller& tell, const Json& state, std::string& said) {
  if (state["instructions"].empty()) return;
  const auto words = state["instructions"][0].value("words", "");
  if (words != said) tell.out << "stagehand: " << words << "\n" << std::flush;
  said = words;
}

core::Result<Json> wait_for_light(const DemoLink& link, std::int64_t look, Teller tell) {
  std::string light, said;
  double since = link.seconds();
  return wait_for_state(link, kLightPatience_s, "the light", [&](const Json& now) {
    tell_stands(tell, now, said);
    const auto& live = now["look"];
    const bool there = live.is_object() && live.value("id", std::int64_t{0}) == look &&
                       live.value("fade", 0.0) >= 1 && now["instructions"].empty();
    if (const auto seen = light_of(now); !there || seen != light) {
      light = seen;
      since = link.seconds();
      return false;
    }
    return link.seconds() - since >= kSettled_s;
  });
}

std::uint64_t frames_of(const Json& state) {
  return state["cameras"].empty() ? 0 : state["cameras"][0].value("frames", std::uint64_t{0});
}

/// Until a frame has come in that was begun after now: the next one may have been on its way.
core::Result<Json> wait_for_fresh_frame(const DemoLink& link, std::uint64_t seen) {
  return wait_for_state(link, kLightPatience_s, "a fresh camera picture",
                        [&](const Json& now) { return frames_of(now) >= seen + 2; });
}

double aspect_of(const core::EncodedPicture& picture) {
  return picture.size.height > 0 ? static_cast<double>(picture.size.width) / picture.size.height
                                 : 1;
}

std::string lamp_in_words(const Json& fixture) {
  std::string text = fixture.value("name", "") + ": ";
  for (const auto* part : {"words", "level", "colour"})
    if (const auto words = fixture.value(part, ""); !words.empty())
      text += (text.back() == ' ' ? "" : " · ") + words;
  return text;
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
  made.difference = lightness_difference(made.preview, made.camera);
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

core::Result<core::Done> light_to_begin_with(const DemoLink& link) {
  const auto state = ask_json(link, "GET", "/api/v1/state");
  if (!state) return state.problems();
  if (!state->value("look", Json()).is_null()) return core::Done{};
  const auto lit = ask(link, "POST", "/api/v1/work-light", "{}");
  if (!lit) return lit.problems();
  return core::Done{};
}

core::Result<MadeLook> make_look(const DemoLink& link, const std::string& mood, double fade_s,
                                 Teller tell) {
  const double start = link.seconds();
  const auto job =
      ask_json(link, "POST", "/api/v1/design", Json{{"mood", mood}, {"seed", 1}}.dump());
  if (!job) return job.problems();
  const auto look = wait_for_design(link, job->value("job", std::uint64_t{0}), tell);
  if (!look) return look.problems();
  const auto applied = ask(link, "POST", fmt::format("/api/v1/looks/{}/apply", *look),
                           Json{{"fade_s", fade_s}}.dump());
  if (!applied) return applied.problems();
  const auto state = wait_for_light(link, *look, tell);
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
  const auto fresh = wait_for_fresh_frame(link, frames_of(*state));
  if (!fresh) return fresh.problems();
  if (const auto taken = take_pictures(link, *fresh, made); !taken) return taken.problems();
  return made;
}

core::EncodedPicture cropped(const core::EncodedPicture& picture, double aspect) {
  const auto whole = picture.size;
  auto size = whole;
  size.width = std::min(whole.width, static_cast<int>(std::lround(whole.height * aspect)));
  size.height = std::min(whole.height, static_cast<int>(std::lround(whole.width / aspect)));
  const int left = (whole.width - size.width) / 2, top = (whole.height - size.height) / 2;
  core::EncodedPicture result(size);
  for (int y = 0; y < size.height; ++y)
    std::copy_n(picture.row(top + y) + left, size.width, result.row(y));
  return result;
}

double lightness_difference(const core::EncodedPicture& a, const core::EncodedPicture& b) {
  const double aspect = std::min(aspect_of(a), aspect_of(b));
  const auto one = cropped(a, aspect), other = cropped(b, aspect);
  const auto size = one.size.height < other.size.height ? one.size : other.size;
  const auto x = core::luminance(core::resized(core::linear(one), size));
  const auto y = core::luminance(core::resized(core::linear(other), size));
  double sum = 0;
  for (std::size_t i = 0; i < x.values.size(); ++i)
    sum += std::abs(core::lightness(x.values[i]) - core::lightness(y.values[i]));
  return x.values.empty() ? 0 : sum / static_cast<double>(x.values.size());
}

core::EncodedPicture side_by_side(const MadeLook& look) {
  constexpr int kGap = 8;
  const core::EncodedPicture* const all[] = {&look.reference, &look.preview, &look.camera};
  double aspect = 1e9;
  for (const auto* picture : all) aspect = std::min(aspect, aspect_of(*picture));
  const int height = look.camera.size.height;
  const int width = std::max(1, static_cast<int>(std::lround(height * aspect)));
  core::EncodedPicture result({3 * width + 2 * kGap, height}, {255, 255, 255});
  int left = 0;
  for (const auto* picture : all) {
    const auto scaled =
        core::encoded(core::resized(core::linear(cropped(*picture, aspect)), {width, height}));
    for (int y = 0; y < height; ++y) std::copy_n(scaled.row(y), width, result.row(y) + left);
    left += width + kGap;
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
