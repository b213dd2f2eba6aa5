// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/state.h"

#include <cmath>

#include "controller/panel/json.h"

namespace chiaro::panel {
namespace {

/// Nine significant digits: 24-bit levels stay apart, and -47.00000000000001 does not show.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double scale = std::pow(10.0, 8 - std::floor(std::log10(std::fabs(value))));
  return std::round(value * scale) / scale;
}

Json json_of(const Refusal& refusal) {
  Json json = {{"what", refusal.what}, {"where", refusal.where}, {"remedy", refusal.remedy}};
  for (const core::Problem& problem : refusal.problems)
    json["problems"].push_back(panel::json_of(problem));
  return json;
}

Json json_of(const Instruction& instruction, bool with_fixture) {
  Json json = Json::object();
  if (with_fixture) json["fixture"] = instruction.fixture;
  json["words"] = instruction.words;
  json["to"] = panel::json_of(instruction.to);
  return json;
}

Json json_of(const FixtureView& fixture, bool counters) {
  Json limits = Json::object();
  for (const auto& [dof, range] : fixture.limits)
    limits[std::string(core::info(dof).file_name)] = {rounded(core::file_value(dof, range.least)),
                                                      rounded(core::file_value(dof, range.most))};
  Json by_hand = Json::array();
  for (const core::Dof dof : fixture.by_hand) by_hand.push_back(core::info(dof).file_name);
  Json json = {{"name", fixture.name},
               {"role", fixture.role},
               {"mount", fixture.mount},
               {"words", fixture.words},
               {"level", fixture.level},
               {"colour", fixture.colour},
               {"light", fixture.light},
               {"lux", rounded(fixture.lux)},
               {"output_cd", rounded(fixture.output_cd)},
               {"measured", fixture.measured},
               {"patch", fixture.patch ? Json({{"universe", fixture.patch->universe},
                                               {"address", fixture.patch->address},
                                               {"slots", fixture.patch->slots}})
                                       : Json(nullptr)},
               {"wanted", panel::json_of(fixture.wanted)},
               {"placed", panel::json_of(fixture.placed)}};
  if (counters) json["sent"] = panel::json_of(fixture.sent);
  json["manual"] = panel::json_of(fixture.manual);
  json["limits"] = limits;
  json["locked"] = fixture.locked;
  json["controlled"] = fixture.controlled;
  json["by_hand"] = by_hand;
  json["instruction"] = fixture.instruction ? json_of(*fixture.instruction, false) : Json(nullptr);
  if (!counters)
    for (const char* name : {"level", "colour", "light", "lux"}) json.erase(name);
  return json;
}

Json json_of(const LookView& look, bool counters) {
  const std::string base = "/api/v1/looks/" + std::to_string(look.id);
  Json json = {{"id", look.id},
               {"name", look.name},
               {"mood", look.mood},
               {"verdict", look.verdict},
               {"verdict_when_placed", look.verdict_when_placed},
               {"remedy", look.remedy},
               {"ratio", look.ratio},
               {"light", look.light},
               {"nudges", Json::object()},
               {"advice", look.advice},
               {"can_nudge", look.can_nudge},
               {"kept", look.kept},
               {"edition", look.edition}};
  for (const auto& [name, stops] : look.nudges) json["nudges"][name] = rounded(stops);
  if (counters) json["fade"] = rounded(look.fade);
  json["picture"] = base + "/picture";
  json["placed_picture"] = base + "/placed_picture";
  json["reference"] = look.reference;
  json["trials"] = look.trials;
  json["seconds"] = rounded(look.seconds);
  return json;
}

Json json_of(const JobView& job, bool counters) {
  Json json = {
      {"job", job.job}, {"mood", job.mood}, {"title", job.title}, {"status", name_of(job.status)}};
  if (counters) {
    json["stage"] = job.stage;
    json["trial"] = job.trial;
    json["trials"] = job.trials;
    json["best"] = rounded(job.best);
    json["seconds"] = rounded(job.seconds);
  }
  json["lit"] = job.lit;
  json["look"] = job.look ? Json(*job.look) : Json(nullptr);
  json["error"] = job.error ? json_of(*job.error) : Json(nullptr);
  return json;
}

Json json_of(const OutputView& output, bool counters) {
  Json json = {{"universe", output.universe},
               {"health", output.health},
               {"rate_hz", rounded(output.rate_hz)}};
  if (!counters) return json;
  json["frames"] = output.frames;
  json["late"] = output.late;
  json["failed"] = output.failed;
  json["missed"] = output.missed;
  json["jitter_us_p50"] = rounded(output.jitter_us_p50);
  json["jitter_us_p99"] = rounded(output.jitter_us_p99);
  json["jitter_us_p999"] = rounded(output.jitter_us_p999);
  return json;
}

Json json_of(const CameraView& camera, bool counters) {
  Json json = {{"name", camera.name}, {"health", camera.health}};
  if (counters) json["frames"] = camera.frames;
  json["reconnects"] = camera.reconnects;
  const std::string base = "/api/v1/cameras/" + camera.name;
  json["picture"] = base + "/picture";
  json["stream"] = base + "/stream";
  return json;
}

template <class Items, class... More>
Json list_of(const Items& items, const More&... more) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(json_of(item, more...));
  return list;
}

Json json_of(const TriedView& tried) {
  if (tried.slots.empty()) return Json::object();
  Json json = {{"universe", tried.universe}, {"slots", Json::object()}};
  for (const auto& [slot, level] : tried.slots) json["slots"][std::to_string(slot)] = level;
  return json;
}

Json instructions_of(const State& state) {
  Json list = Json::array();
  for (const FixtureView& fixture : state.fixtures)
    if (fixture.instruction) list.push_back(json_of(*fixture.instruction, true));
  return list;
}

/// File names may hold bytes that are not UTF-8; they must not turn a good answer into a fault.
std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json json_of(const core::FixtureState& state) {
  Json json = Json::object();
  for (const core::DofInfo& dof : core::dofs())
    if (state.has(dof.dof))
      json[std::string(dof.file_name)] = rounded(core::file_value(dof.dof, state.get(dof.dof)));
  return json;
}

Json json_of(const core::Problem& problem) {
  return {{"what", problem.what},
          {"where", problem.where.file.empty() ? "" : core::to_string(problem.where)},
          {"remedy", problem.remedy},
          {"warning", problem.warning}};
}

std::string_view name_of(JobStatus status) {
  switch (status) {
    case JobStatus::queued:
      return "queued";
    case JobStatus::running:
      return "running";
    case JobStatus::done:
      return "done";
    case JobStatus::failed:
      return "failed";
    case JobStatus::cancelled:
      return "cancelled";
  }
  return "";
}

const FixtureView* State::fixture(std::string_view name) const {
  for (const FixtureView& candidate : fixtures)
    if (candidate.name == name) return &candidate;
  return nullptr;
}

std::string state_to_json(const State& state, bool counters) {
  Json json = Json::object();
  if (counters) json["version"] = state.version;
  json["studio"] = {{"name", state.studio},
                    {"file", state.file},
                    {"fingerprint", state.fingerprint},
                    {"ready", state.ready},
                    {"stage", state.stage}};
  json["hand"] = {{"connected", state.hand_connected},
                  {"refused", state.hand_refused},
                  {"real_time", state.real_time}};
  json["caution"] = state.caution;
  json["blackout"] = state.blackout;
  json["motion"] = {{"stopped", state.motion_stopped},
                    {"armed", state.motion_armed},
                    {"axes_waiting", state.axes_waiting}};
  Json masters = Json::object();
  for (std::size_t i = 0; i < state.masters.size(); ++i)
    masters[kMasterNames[i]] = rounded(state.masters[i]);
  json["masters"] = masters;
  json["look"] = state.look ? json_of(*state.look, counters) : Json(nullptr);
  json["design"] = state.design ? json_of(*state.design, counters) : Json(nullptr);
  json["fixtures"] = list_of(state.fixtures, counters);
  json["instructions"] = instructions_of(state);
  json["outputs"] = list_of(state.outputs, counters);
  json["cameras"] = list_of(state.cameras, counters);
  json["tried"] = json_of(state.tried);
  Json problems = Json::array();
  for (const core::Problem& problem : state.problems) problems.push_back(json_of(problem));
  json["problems"] = problems;
  json["can_undo"] = state.can_undo;
  return text(json);
}

std::string slots_to_json(const State& state, const OutputView& output) {
  Json owners = Json::array();
  for (const FixtureView& fixture : state.fixtures)
    if (fixture.patch && fixture.patch->universe == output.universe)
      owners.push_back({{"fixture", fixture.name},
                        {"first", fixture.patch->address},
                        {"last", fixture.patch->address + fixture.patch->slots - 1}});
  return text({{"universe", output.universe}, {"slots", output.slots}, {"owners", owners}});
}

std::string moods_to_json(const State& state) {
  Json list = Json::array();
  for (const MoodView& mood : state.moods)
    list.push_back({{"name", mood.name},
                    {"title", mood.title},
                    {"sentence", mood.sentence},
                    {"tags", mood.tags},
                    {"attainable", mood.attainable},
                    {"own", mood.own},
                    {"words", mood.words},
                    {"turn", mood.turn},
                    {"picture", "/api/v1/moods/" + mood.name + "/picture"}});
  return text({{"moods", list}});
}

std::string job_to_json(const JobView& job) { return text(json_of(job, true)); }

std::string refusal_to_json(const Refusal& refusal) { return text({{"error", json_of(refusal)}}); }

}  // namespace chiaro::panel
