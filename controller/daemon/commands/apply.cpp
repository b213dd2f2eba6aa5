// SPDX-License-Identifier: Apache-2.0
// `chiaro apply LOOK`: the daemon fades to it. With --dry-run the same levels go through the same
// limits and patch up to the last step: the slots are printed, nothing is sent.
#include <CLI/CLI.hpp>
#include <charconv>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/brain/console.h"
#include "controller/daemon/command.h"
#include "controller/daemon/problems.h"
#include "controller/design/design.h"
#include "controller/patch/plan.h"
#include "controller/rig/governor.h"
#include "controller/studio/load.h"
#include "drivers/common/http_client.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::ordered_json;

struct Asked {
  std::string look, fade = "3s", daemon = "http://127.0.0.1:8090", studio, token;
  bool dry_run = false;
};

/// "3s", "1.5 s", "500ms", "2": seconds.
std::optional<double> seconds_of(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string unit(end, text.data() + text.size());
  unit.erase(0, unit.find_first_not_of(' '));
  if (code != std::errc() || !(value >= 0)) return std::nullopt;
  if (unit == "ms") value /= 1000;
  if ((unit != "" && unit != "s" && unit != "ms") || value > 600) return std::nullopt;
  return value;
}

core::Result<std::string> text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.is_open() && !text.empty()) return text;
  return core::Problem{{file, 0, 0},
                       stream.is_open() ? "the file is empty" : "there is no such file",
                       "write a look with: chiaro design STUDIO --mood NAME --out look.json"};
}

/// The daemon's answer as JSON; a problem when it is not there or refuses. `reached` tells which.
core::Result<Json> ask(const Asked& asked, const std::string& method, const std::string& path,
                       const std::string& body, bool& reached) {
  drivers::HttpRequest request{method, asked.daemon + "/api/v1" + path, body};
  request.token = asked.token;
  const auto reply = drivers::http_request(request, std::chrono::seconds(10));
  reached = static_cast<bool>(reply);
  if (!reply)
    return core::Problem{{},
                         "the daemon at " + asked.daemon + " does not answer",
                         "start it with: chiarod STUDIO, or give its address with --daemon"};
  Json json = Json::parse(reply->body, nullptr, false);
  if (reply->status < 300 && json.is_object()) return json;
  const Json error = json.is_object() ? json.value("error", Json::object()) : Json::object();
  return core::Problem{{error.value("where", ""), 0, 0},
                       error.value("what", "the daemon answered " + std::to_string(reply->status)),
                       error.value("remedy", "see the daemon's own messages")};
}

ports::Exit refuse_with(const core::Problems& problems, bool reached, ports::World& world,
                        bool json) {
  refuse(problems, world, json);
  return reached ? ports::Exit::input_has_problems : ports::Exit::out_of_reach;
}

ports::Exit apply(const Asked& asked, double fade_s, ports::World& world, bool json) {
  const auto text = text_of(asked.look);
  if (!text) return refuse(text.problems(), world, json);
  const Json look = Json::parse(*text, nullptr, false);
  if (!look.is_object())
    return refuse({{{asked.look, 1, 1}, "this is not a look", "give a look.json"}}, world, json);
  bool reached = false;
  const auto saved = ask(asked, "POST", "/looks", Json({{"look", look}}).dump(), reached);
  if (!saved) return refuse_with(saved.problems(), reached, world, json);
  const std::int64_t id = saved->value("id", std::int64_t{0});
  const auto applied = ask(asked, "POST", "/looks/" + std::to_string(id) + "/apply",
                           Json({{"fade_s", fade_s}}).dump(), reached);
  if (!applied) return refuse_with(applied.problems(), reached, world, json);
  if (json)
    world.out << Json({{"look", id}, {"fade_s", fade_s}}).dump() << "\n";
  else
    world.err << "Fading to '" << look.value("name", asked.look) << "' in " << fade_s << " s.\n";
  return ports::Exit::done;
}

/// The levels that the hand would send once the fade is over, through every limit.
std::vector<ports::DmxFrame> frames_of(const studio::Studio& studio, const studio::Rig& rig,
                                       const patch::Plan& plan, ports::TimePoint now) {
  Console console(studio);
  console.apply(studio, rig, 0, now);
  rig::Wanted wanted = console.wanted();
  wanted.studio_fingerprint = studio.fingerprint;
  rig::Governor governor(studio, now);
  // Slew limits may stretch even a cut: an hour is enough for any.
  constexpr auto kSettled = std::chrono::hours(1);
  wanted.posted_ns = now.time_since_epoch().count();
  governor.take(wanted, now);
  governor.step(now);
  wanted.posted_ns = (now + kSettled).time_since_epoch().count();
  governor.take(wanted, now + kSettled);
  std::vector<ports::DmxFrame> frames = plan.blank_frames();
  plan.encode(governor.step(now + kSettled), frames);
  return frames;
}

Json slots_of(const patch::Plan& plan, const std::vector<ports::DmxFrame>& frames,
              const studio::Studio& studio) {
  Json list = Json::array();
  for (const patch::Plan::Line& line : plan.sheet()) {
    Json values = Json::array();
    for (const ports::DmxFrame& frame : frames)
      for (int slot = line.first; frame.universe == line.universe && slot <= line.last; ++slot)
        values.push_back(frame.levels[static_cast<std::size_t>(slot - 1)]);
    list.push_back({{"universe", line.universe},
                    {"slot", line.first},
                    {"fixture", studio.fixtures[line.fixture].name},
                    {"channel", line.channel},
                    {"values", values}});
  }
  return list;
}

void print(const Json& slots, std::ostream& out) {
  for (const Json& line : slots) {
    out << "universe " << line["universe"] << " slot " << line["slot"] << ": ";
    for (const Json& value : line["values"]) out << value << " ";
    out << " " << line["fixture"].get<std::string>() << " " << line["channel"].get<std::string>()
        << "\n";
  }
}

ports::Exit dry_run(const Asked& asked, ports::World& world, bool json) {
  const auto text = text_of(asked.look);
  if (!text) return refuse(text.problems(), world, json);
  std::string file = asked.studio;
  if (file.empty()) {
    bool reached = false;
    const auto state = ask(asked, "GET", "/state", "", reached);
    if (!state)
      return refuse_with({{{},
                           "without a daemon the studio is not known: " + state.problems()[0].what,
                           "give the studio file with --studio"}},
                         reached, world, json);
    file = state->at("studio").at("file").get<std::string>();
  }
  const auto loaded = studio::load_studio(file, {world.config_folder});
  if (!loaded) return refuse(loaded.problems(), world, json);
  const auto look = design::look_from_json(loaded->studio, *text, asked.look);
  if (!look) return refuse(look.problems(), world, json);
  const patch::Plan plan = patch::Plan::of(loaded->studio);
  const auto frames = frames_of(loaded->studio, look->placed, plan, world.clock.now());
  const Json slots = slots_of(plan, frames, loaded->studio);
  world.err << "Dry run: nothing is sent. These are the slots once the fade is over.\n";
  if (json)
    world.out << Json({{"dry_run", true}, {"slots", slots}}).dump() << "\n";
  else
    print(slots, world.out);
  return ports::Exit::done;
}

}  // namespace

void declare_apply(CLI::App& app, ports::World& world, Verdict& verdict) {
  auto* verb = app.add_subcommand("apply", "fades to a look, through the daemon");
  auto asked = std::make_shared<Asked>();
  verb->add_option("LOOK", asked->look, "a look.json, as `chiaro design --out` writes it")
      ->required();
  verb->add_option("--fade", asked->fade, "how long the fade takes: 3s, 500ms")
      ->capture_default_str()
      ->check([](const std::string& text) {
        return seconds_of(text) ? "" : "give a time from 0s to 600s, such as 3s or 500ms";
      });
  verb->add_flag("--dry-run", asked->dry_run, "print the slots, send nothing");
  verb->add_option("--daemon", asked->daemon, "the daemon's address")->capture_default_str();
  verb->add_option("--token", asked->token, "what chiarod was given as --token")
      ->envname("CHIARO_TOKEN")
      ->check([](const std::string& token) {
        return token.find_first_of("\r\n") == std::string::npos ? "" : "a token is one line";
      });
  verb->add_option("--studio", asked->studio, "for --dry-run: the studio file (else the daemon's)");
  verb->callback([asked, &world, &verdict] {
    verdict.exit = asked->dry_run ? dry_run(*asked, world, verdict.json)
                                  : apply(*asked, *seconds_of(asked->fade), world, verdict.json);
  });
}

}  // namespace chiaro::daemon
