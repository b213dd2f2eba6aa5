// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/answers.h"

#include <nlohmann/json.hpp>

#include "controller/daemon/output/answer_words.h"
#include "controller/daemon/output/state_json.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;
using rig::Mark;

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

Json axis_json(const Housekeeper::Axis& axis, const studio::Studio& studio) {
  const ports::AxisReport& report = axis.report;
  Json json{{"universe", axis.universe}, {"address", report.slot + 1},
            {"fixture", nullptr},        {"place", report.place >= 0 ? Json(report.place) : Json()},
            {"wanted", report.wanted},   {"moving", report.moving},
            {"homed", report.homed},     {"fault", report.fault},
            {"heard", report.heard}};
  for (const auto& fixture : studio.fixtures)
    if (const auto motor = fixture.far_motor();
        motor && motor->patch.universe == axis.universe && motor->patch.address == report.slot + 1)
      json["fixture"] = fixture.name;
  return json;
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
    return outcome ? text_of(Json{{"reload", true}}) : refusal(outcome.problems());
  }
  if (line == "release") {
    release_ = true;
    return text_of(Json{{"release", true}});
  }
  if (verb == "motion") return motion(rest);
  if (verb == "mark") return mark(rest);
  if (verb == "level") return level(rest);
  if (verb == "master") return master(rest);
  if (line == "blind on" || line == "blind off") return blind(line == "blind on");
  if (verb == "record") return tape(rest);
  if (verb == "cue") return cue(rest);
  return refusal("unknown request '" + cut(line, 40) + "'",
                 "known: blackout, motion, mark, marks, level, master, blind, cue, record, "
                 "status, reload, release");
}

std::string Answers::blackout(bool on) {
  const std::uint64_t wish = hand_.wish_blackout(on);
  if (wait([&] { return hand_.taken(wish); })) return text_of(Json{{"blackout", on}});
  return refusal("the output loop did not take the blackout within a second",
                 "switch the lamps' mains off if they must go dark now");
}

/// Only a person homes a motor, and only one that may move: it may run through its whole range.
std::string Answers::home(const std::string& lamp) {
  const studio::Studio studio = housekeeper_.studio_now();
  const auto index = studio.fixture_index(lamp);
  const auto motor = index ? studio.fixtures[*index].far_motor() : std::nullopt;
  std::vector<std::string> names;
  for (const auto& fixture : studio.fixtures)
    if (fixture.far_motor()) names.push_back(fixture.name);
  if (!motor) {
    const std::string near = core::nearest_name(lamp, names);
    return refusal("no motor of '" + lamp + "' has an address of its own",
                   near.empty() ? "`chiaro check` lists them" : "did you mean '" + near + "'?");
  }
  const auto axes = housekeeper_.axes_now();
  const auto axis = std::find_if(axes.begin(), axes.end(), [&](const Housekeeper::Axis& one) {
    return one.universe == motor->patch.universe && one.report.slot + 1 == motor->patch.address;
  });
  if (axis == axes.end() || !axis->report.can_home)
    return refusal("the motor of '" + lamp + "' knows no order to find its home",
                   "give its register map a `home`");
  if (!housekeeper_.newest_report().motion_armed.on)
    return refusal("motion is not armed", "see that nobody is near, then `chiaro motion arm`");
  Wish wish;
  wish.kind = Wish::Kind::home;
  wish.fixture = static_cast<std::uint32_t>(*index);
  wish.studio = studio.fingerprint;
  return done(wish) ? text_of(Json{{"home", lamp}}) : not_in_time();
}

std::string Answers::motion(const std::string& word) {
  if (word.rfind("home ", 0) == 0) return home(word.substr(5));
  Wish wish;
  wish.kind =
      word == "stop" || word == "release" ? Wish::Kind::motion_stop : Wish::Kind::motion_arm;
  wish.on = word == "stop" || word == "arm";
  if (!wish.on && word != "release" && word != "disarm")
    return refusal("unknown motion request '" + word + "'",
                   "known: stop, release, arm, disarm, home LAMP");
  if (!done(wish))
    return refusal("the output loop did not act within a second",
                   "cut the motors' power if they must stand still now");
  const rig::Sent sent = housekeeper_.newest_report();
  if (word == "arm" && sent.motion_stop.on)
    return refusal("motion is stopped, so it cannot be armed", "`chiaro motion release` first");
  return text_of(Json{{"stopped", sent.motion_stop.on},
                      {"armed", sent.motion_armed.on},
                      {"axes_waiting", sent.axes_waiting}});
}

std::string Answers::tape(const std::string& words) {
  std::string rest = words;
  const std::string verb = first_of(rest);
  Recorder& recorder = housekeeper_.recorder();
  Recorder::State state = recorder.state();
  if (verb == "start" && std::filesystem::path(rest).is_absolute()) {
    if (const auto started = recorder.start(rest, housekeeper_.studio_now()); !started)
      return refusal(started.problems());
    state = recorder.state();
  } else if (words == "stop") {
    const auto stopped = recorder.stop();
    if (!stopped) return refusal(stopped.problems());
    state = *stopped;
  } else if (words != "status") {
    return refusal("unknown request 'record " + cut(words, 60) + "'",
                   "record start FILE with its whole path, record stop, record status");
  }
  return text_of(Json{{"recording", state.on},
                      {"file", state.file},
                      {"seconds", state.seconds},
                      {"ticks", state.ticks},
                      {"bytes", state.bytes},
                      {"lost", state.lost}});
}

std::string Answers::status() const {
  const rig::Sent sent = housekeeper_.newest_report();
  const studio::Studio studio = housekeeper_.studio_now();
  Json json{{"caution", rig::name_of(sent.caution)},
            {"blackout", sent.blackout},
            {"blind", sent.blind},
            {"masters", Json::object()},
            {"motion",
             {{"stopped", sent.motion_stop.on},
              {"armed", sent.motion_armed.on},
              {"axes_waiting", sent.axes_waiting}}},
            {"refused", sent.refused},
            {"real_time", sent.real_time},
            {"dry_run", sent.dry_run},
            {"cue", Json::parse(cue_now(sent))},
            {"lamps", Json::array()},
            {"axes", Json::array()},
            {"circuits", Json::array()},
            {"ports", Json::array()}};
  for (std::size_t m = 0; m < rig::kMasters; ++m)
    json["masters"][std::string(rig::name_of(static_cast<rig::Master>(m)))] = sent.masters[m];
  for (std::size_t i = 0; i < studio.fixtures.size() && i < sent.marks.size(); ++i)
    if (sent.marks[i] != 0 || sent.limited[i] != 0)
      json["lamps"].push_back(lamp_json(studio.fixtures[i].name, sent.marks[i], sent.limited[i]));
  for (std::size_t i = 0; i < studio.circuits.size() && i < sent.circuits.size(); ++i)
    json["circuits"].push_back({{"name", studio.circuits[i].name},
                                {"limit_w", studio.circuits[i].limit_w},
                                {"draw_w", sent.circuits[i].draw_w},
                                {"scale", sent.circuits[i].scale}});
  for (const auto& port : sent.ports) json["ports"].push_back(port_json(port));
  for (const auto& axis : housekeeper_.axes_now()) json["axes"].push_back(axis_json(axis, studio));
  return text_of(json);
}

}  // namespace chiaro::daemon
